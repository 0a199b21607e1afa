//! Warnings of terms that move nothing.

use flow_core::run::{Prediction, Scene};

/// A sentence on each term whose derivative the normal mobility takes to zero: a constant, whose rounding is all that it can do.
pub fn warnings(prediction: &Prediction, scene: &Scene) -> Vec<String> {
    let idle = [
        ("length", prediction.kept.length && scene.energy.length.is_some()),
        ("area", prediction.kept.area && scene.energy.area.is_some()),
    ];
    let name = scene.flow.normal_mobility.name();
    let sentence = |(key, _): (&str, bool)| {
        format!(
            "energy.{key} moves nothing, since normal_mobility = \"{name}\" keeps the {key}; leave it out"
        )
    };
    idle.into_iter().filter(|(_, is_idle)| *is_idle).map(sentence).collect()
}
