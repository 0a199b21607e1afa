//! What a run will take: nodes, memory, time; measured on a trial run at a loose tolerance.

use std::time::Instant;

use super::limits::{MOST_FRAME_BYTES, check_frame_bytes, file_bytes, frame_bytes, frames, matrix_bytes};
use super::observer::Quiet;
use super::record::{Record, StopReason};
use super::resolution::{MOST_NODES, fronts, size_above};
use super::scene::{Frames, Nodes, Scene, Spacing};
use super::seconds::Spending;
use super::setup::Setup;
use super::setup_error::SetupError;
use super::simulation::Simulation;
use crate::flow::{Kept, MetricRole};
use crate::geometry::Layout;

/// Prediction of a run. Steps, time and most nodes are rough: within a factor of two for the shipped scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Number of nodes at the start.
    pub nodes: usize,
    /// Most nodes expected on the way.
    pub most_nodes: usize,
    /// Length of the state vector at the start.
    pub unknowns: usize,
    /// Memory of the process: program, solver, pairs of nodes under adhesion, all frames, and the file before it is written.
    pub memory_bytes: f64,
    /// Number of frames if every one is reached, and their bytes on the most nodes.
    pub frames: usize,
    /// See [`Prediction::frames`].
    pub frame_bytes: f64,
    /// Size of the result file if every frame is reached.
    pub file_bytes: f64,
    /// Number of steps until the run stops.
    pub steps: f64,
    /// Seconds of the integration.
    pub integration_seconds: f64,
    /// Seconds for frames and the file.
    pub output_seconds: f64,
    /// What the flow keeps, whatever the energy.
    pub kept: Kept,
    /// What this was measured on.
    pub trial: Trial,
}

impl Prediction {
    /// Whether a run may have all its frames on the most nodes. They are asked for at the start on its first nodes, and a run that
    /// grows ends where they become too many.
    ///
    /// # Errors
    /// [`SetupError::TooMuchOutput`], with which such a run would end.
    pub fn check_frames(&self) -> Result<(), SetupError> {
        check_frame_bytes(self.frames, self.most_nodes, self.frame_bytes, MOST_FRAME_BYTES)
    }
}

/// A run of the scene at a loose tolerance with few frames, for a second, or for a few if its steps are dear.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Its tolerance.
    pub tolerance: f64,
    /// The time that it reached.
    pub time: f64,
    /// Why it stopped; none if it was given up.
    pub stop_reason: Option<StopReason>,
}

/// Tolerance of the trial, unless the scene asks for a looser one.
const TRIAL_TOLERANCE: f64 = 1e-2;
const TRIAL_FRAMES: usize = 8;
/// A trial is given up after so many seconds, after so many times that if it has taken a few steps only, and not before two.
const TRIAL_SECONDS: f64 = 1.0;
const FOR_FEW_STEPS: f64 = 4.0;
const FEW_STEPS: usize = 12;
/// Powers of the tolerance by which steps and nodes grow: the table of the dial in `benches/README.md`.
const STEPS_POWER: f64 = 0.16;
const NODES_POWER: f64 = 0.066;
/// Fewest steps in a decade of time that a trial has not seen.
const LEAST_PER_DECADE: f64 = 5.0;
/// Vectors of the size of the state that the solver holds: history, Krylov basis, scratch.
const SOLVER_VECTORS: f64 = 80.0;
/// Memory of the program itself, and copies of all frames while the file is made: measured on files of 0.2 to 800 MB.
const PROGRAM_BYTES: f64 = 14e6;
const COPIES_OF_FRAMES: f64 = 3.0;
/// Bytes of a file per second, checksums included.
const FILE_BYTES_PER_SECOND: f64 = 300e6;

/// Predicts a run of `scene`.
///
/// # Errors
/// [`SetupError`] if the scene makes no initial state.
pub fn predict(scene: &Scene) -> Result<Prediction, SetupError> {
    let scene = &scene.clone().checked()?;
    let layout = start(scene)?;
    let Run { record, step_ends, kept, kept_per_square } = run_trial(&trial_scene(scene))?;
    let trial = Trial {
        tolerance: trial_tolerance(scene),
        time: record.steps.time.last().copied().unwrap_or(0.0),
        stop_reason: (record.stop_reason != StopReason::Interrupted).then(|| record.stop_reason.clone()),
    };
    let tighter = trial.tolerance / scene.accuracy.tolerance;
    let most_nodes = most_nodes(scene, layout.nodes(), &record, tighter);
    let (steps, seconds) = match trial.stop_reason {
        Some(_) => (step_ends.len() as f64, step_ends.last().copied().unwrap_or(0.0)),
        None => extrapolated(&record.steps.time, &step_ends, scene.time.end),
    };
    let finer = tighter.powf(STEPS_POWER);

    let most_layout = Layout::new(most_nodes, layout.densities());
    let frames = frames(scene);
    let frame_bytes = frame_bytes(frames, most_layout, record.fields.len());
    let file_bytes = file_bytes(scene, most_layout, record.fields.len(), steps * finer);
    let seconds_per_node =
        record.seconds[Spending::Frames] / (record.frames.len() * record.frames[0].curvature.len()) as f64;
    Ok(Prediction {
        nodes: layout.nodes(),
        most_nodes,
        unknowns: layout.len(),
        memory_bytes: PROGRAM_BYTES
            + 8.0 * SOLVER_VECTORS * most_layout.len() as f64
            + kept_per_square * (most_nodes as f64).powi(2)
            + matrix_bytes(scene, most_layout)
            + COPIES_OF_FRAMES * frame_bytes,
        frames,
        frame_bytes,
        file_bytes,
        steps: steps * finer,
        integration_seconds: seconds * finer,
        output_seconds: seconds_per_node * (frames * most_nodes) as f64 + file_bytes / FILE_BYTES_PER_SECOND,
        kept,
        trial,
    })
}

/// Shape of the state at the start of `scene`. What else may be wrong with one whose nodes are given its trial finds out: they are the
/// same there, and to evaluate many of them may take seconds.
fn start(scene: &Scene) -> Result<Layout, SetupError> {
    match scene.accuracy.nodes {
        Nodes::Count(_) => Ok(Setup::new(scene)?.membrane.layout()),
        Nodes::Auto => Ok(Simulation::new(scene)?.layout()),
    }
}

fn trial_tolerance(scene: &Scene) -> f64 {
    scene.accuracy.tolerance.max(TRIAL_TOLERANCE)
}

fn trial_scene(scene: &Scene) -> Scene {
    let mut trial = scene.clone();
    trial.accuracy.tolerance = trial_tolerance(scene);
    trial.output.frames = Frames::Spaced { frames: TRIAL_FRAMES, spacing: Spacing::Linear };
    trial.time.max_steps = None; // of other steps
    trial.renewed()
}

/// What a trial has left.
struct Run {
    record: Record,
    /// Seconds of integration until the end of each step.
    step_ends: Vec<f64>,
    kept: Kept,
    /// Most bytes that the terms of the energy kept, per square of the number of nodes.
    kept_per_square: f64,
}

fn run_trial(scene: &Scene) -> Result<Run, SetupError> {
    let start = Instant::now();
    let mut simulation = Simulation::new(scene)?;
    let kept = simulation.keeps();
    let (mut step_ends, mut seconds, mut kept_per_square) = (Vec::new(), 0.0, 0.0_f64);
    let mut under_way = true;
    while under_way && start.elapsed().as_secs_f64() < patience(step_ends.len()) {
        let clock = Instant::now();
        under_way = simulation.step(&mut Quiet);
        seconds += clock.elapsed().as_secs_f64();
        step_ends.push(seconds);
        let nodes = simulation.layout().nodes() as f64;
        kept_per_square = kept_per_square.max(simulation.kept_bytes() / nodes.powi(2));
    }
    Ok(Run { record: simulation.into_record(), step_ends, kept, kept_per_square })
}

/// Seconds of a trial that has taken so many steps: a few more for a few steps that tell something.
fn patience(steps: usize) -> f64 {
    match steps {
        0..2 => f64::INFINITY,
        2..FEW_STEPS => FOR_FEW_STEPS * TRIAL_SECONDS,
        _ => TRIAL_SECONDS,
    }
}

/// Steps and seconds to `end` of a trial that was given up: as many steps in each decade of the time, and as long ones, as in its
/// later half.
fn extrapolated(times: &[f64], step_ends: &[f64], end: f64) -> (f64, f64) {
    let (taken, half) = (times.len(), times.len() / 2);
    let later = (taken - half) as f64;
    let per_decade = (later / (times[taken - 1] / times[half - 1]).log10()).max(LEAST_PER_DECADE);
    let more = per_decade * (end / times[taken - 1]).log10().max(0.0);
    let seconds = step_ends[taken - 1];
    (taken as f64 + more, seconds + more * (seconds - step_ends[half - 1]) / later)
}

/// Most nodes of the scene, which starts with `nodes`, from those of the trial of `record` at a tolerance that many times looser.
fn most_nodes(scene: &Scene, nodes: usize, record: &Record, tighter: f64) -> usize {
    if scene.accuracy.nodes != Nodes::Auto {
        return nodes;
    }
    let taken = &record.steps.nodes;
    let (first, most) = (taken.first().copied().unwrap_or(0), taken.iter().copied().max().unwrap_or(0));
    let grown = if most > first { f64::from(most) * tighter.powf(NODES_POWER) } else { 0.0 };
    // Fronts that the trial may not have reached.
    let unseen =
        record.stop_reason == StopReason::Interrupted && scene.flow.gauge.metric() == MetricRole::Uniform;
    let fronts = if unseen { fronts(scene, record.frames[0].length) } else { 0.0 };
    nodes.max(size_above(grown.max(fronts)).min(MOST_NODES))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten steps in a decade, the later ones twice as long.
    #[test]
    fn a_trial_that_was_given_up_goes_on_as_in_its_later_half() {
        let times: Vec<f64> = (1..=20).map(|step| 10_f64.powf(0.1 * f64::from(step))).collect();
        let step_ends: Vec<f64> = (1..=20).map(|step| f64::from(step + (step - 10).max(0))).collect();
        let (steps, seconds) = extrapolated(&times, &step_ends, 1e4);
        assert!((steps - 40.0).abs() < 1e-9 && (seconds - 70.0).abs() < 1e-9, "{steps} steps, {seconds} s");
    }
}
