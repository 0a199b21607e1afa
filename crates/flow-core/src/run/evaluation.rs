//! The energy of a scene and its force on a curve that is given by arrays.

use std::sync::Arc;

use super::assembly;
use super::own_terms::OwnTerms;
use super::scene::{Gauge, Nodes, Scene};
use super::setup::Setup;
use super::setup_error::SetupError;
use crate::flow::{MetricRole, NodalError, check, nodal_state};
use crate::geometry::Grading;

/// Why the energy of a scene cannot be evaluated on arrays.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum EvaluationError {
    /// The scene makes no energy on so many nodes.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The arrays are not those of a curve.
    #[error(transparent)]
    Arrays(#[from] NodalError),
    /// Another number of densities.
    #[error("the scene has {expected} densities, and {found} were given")]
    Densities { expected: usize, found: usize },
}

/// The energy of a scene at one state.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Energy `𝓕_h` (D3).
    pub energy: f64,
    /// Force f on the normal motion (F3), one value per node.
    pub normal_force: Vec<f64>,
}

/// Evaluates the energy of `scene` on the curve of `curvature` and `metric` with each `density`, one value per node, in the
/// derivative of the scene and the gauge that it has such a metric in. Targets relative to the initial curve are relative
/// to that of the scene.
///
/// # Errors
/// [`EvaluationError`] if the arrays do not fit together or the scene.
pub fn evaluate(
    scene: &Scene,
    curvature: &[f64],
    metric: &[f64],
    density: &[&[f64]],
) -> Result<Evaluation, EvaluationError> {
    let mut scene = scene.clone().checked().map_err(SetupError::from)?;
    let (nodes, expected) = (curvature.len(), scene.density.len());
    if density.len() != expected {
        return Err(EvaluationError::Densities { expected, found: density.len() });
    }
    check(nodes, curvature, metric, density)?;
    scene.accuracy.nodes = Nodes::Count(nodes);
    let initial = Setup::of(&scene, OwnTerms::default())?.initial;
    scene.flow.gauge = gauge(&scene, metric);
    let uniform = scene.flow.gauge.metric() == MetricRole::Uniform;
    let grading =
        if uniform { None } else { Some(Arc::new(Grading::of_metric(metric).map_err(NodalError::from)?)) };
    let (mut flow, _) = assembly::flow(&scene, &initial, nodes, grading)?;
    let state = nodal_state(curvature, metric, density, flow.layout());
    let energy = flow.dissipation_at(&state).energy;
    Ok(Evaluation { energy, normal_force: flow.normal_force().to_vec() })
}

/// The gauge that the scene has such a metric in: its only one, or, where it switches, the first that allows it.
fn gauge(scene: &Scene, metric: &[f64]) -> Gauge {
    let rest = Gauge::at_rest(metric);
    let mut gauges =
        std::iter::once(scene.flow.gauge).chain(scene.flow.switch.iter().map(|switch| switch.gauge));
    let allowed = |gauge: &Gauge| *gauge == rest || gauge.metric() == MetricRole::Field;
    gauges.find(allowed).unwrap_or(rest)
}
