//! Warnings of terms that move nothing.

use flow_core::run::Scene;
use flow_core::run::scene::NormalMobility;

/// A sentence on each term whose derivative the normal mobility takes to zero: a constant, for which steps are shorter all the same.
pub fn warnings(scene: &Scene) -> Vec<String> {
    let mobility = scene.flow.normal_mobility;
    let (length, area) = kept(mobility);
    let idle =
        [("length", length && scene.energy.length.is_some()), ("area", area && scene.energy.area.is_some())];
    let sentence = |(key, _): (&str, bool)| {
        let name = mobility.name();
        format!(
            "energy.{key} moves nothing, since normal_mobility = \"{name}\" keeps the {key}; leave it out"
        )
    };
    idle.into_iter().filter(|(_, is_idle)| *is_idle).map(sentence).collect()
}

/// Whether a mobility keeps the length, and the area.
fn kept(mobility: NormalMobility) -> (bool, bool) {
    match mobility {
        NormalMobility::Incompressible => (true, false),
        NormalMobility::AreaPreserving | NormalMobility::SurfaceDiffusion => (false, true),
        NormalMobility::IncompressibleAreaPreserving => (true, true),
        _ => (false, false),
    }
}
