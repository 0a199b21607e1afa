//! What a run will take: nodes, memory, time; measured on a few trial steps.

use super::limits::frame_bytes;
use super::observer::Quiet;
use super::resolution::{fronts, size_above};
use super::scene::{Nodes, Scene};
use super::setup_error::SetupError;
use super::simulation::Simulation;
use crate::flow::MetricRole;
use crate::geometry::Layout;

/// Prediction of a run. Steps and time are rough: within a factor of three for the shipped scenes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// Number of nodes at the start.
    pub nodes: usize,
    /// Most nodes expected, where the program chooses them: those that the fronts of the agents need at equal distances.
    pub most_nodes: usize,
    /// Length of the state vector.
    pub unknowns: usize,
    /// Memory of the solver and of all frames.
    pub memory_bytes: f64,
    /// Size of the result file if every frame is reached.
    pub file_bytes: f64,
    /// Seconds per step, measured.
    pub seconds_per_step: f64,
    /// Number of steps until the end time.
    pub steps: f64,
}

/// Steps taken to measure.
const TRIAL_STEPS: u64 = 12;
/// Vectors of the size of the state that the solver holds: history, Krylov basis, scratch.
const SOLVER_VECTORS: f64 = 80.0;
/// Steps per decade of time at tolerance 1e-5, and the power of the tolerance by which they grow.
const STEPS_PER_DECADE: f64 = 16.0;
const POWER: f64 = 0.13;

/// Predicts a run of `scene`.
///
/// # Errors
/// [`SetupError`] if the scene makes no initial state.
pub fn predict(scene: &Scene) -> Result<Prediction, SetupError> {
    let scene = &scene.clone().checked()?;
    let mut simulation = Simulation::new(scene)?;
    let layout = simulation.layout();
    while simulation.counters().steps < TRIAL_STEPS && simulation.step(&mut Quiet) {}
    let steps_taken = simulation.counters().steps.max(1) as f64;
    let time = simulation.time().max(f64::MIN_POSITIVE);
    let record = simulation.into_record();
    let most_nodes = most_nodes(scene, layout.nodes(), record.frames[0].length);
    let file_bytes = frame_bytes(scene, Layout::new(most_nodes, layout.densities()), record.fields.len());
    let decades = (scene.time.end / time).log10().max(0.0);
    let finer = (1e-5 / scene.accuracy.tolerance).powf(POWER);
    Ok(Prediction {
        nodes: layout.nodes(),
        most_nodes,
        unknowns: layout.len(),
        memory_bytes: 8.0 * SOLVER_VECTORS * layout.len() as f64 + file_bytes,
        file_bytes,
        seconds_per_step: record.counters.integration_seconds / steps_taken,
        steps: steps_taken + STEPS_PER_DECADE * decades * finer,
    })
}

fn most_nodes(scene: &Scene, nodes: usize, initial_length: f64) -> usize {
    let equidistant = scene.flow.gauge.metric() == MetricRole::Uniform;
    match scene.accuracy.nodes {
        Nodes::Auto if equidistant => nodes.max(size_above(fronts(scene, initial_length))),
        _ => nodes,
    }
}
