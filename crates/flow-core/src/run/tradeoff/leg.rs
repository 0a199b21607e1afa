//! One run of a ladder: a scene to the common end, with its states at the times of comparison.

use super::super::constant_energy::energy_scale;
use super::super::observer::Observer;
use super::super::record::{Frame, Record, StopReason};
use super::super::scene::{Frames, Nodes, Output, Scene};
use super::super::simulation::run;
use super::error::RunError;
use super::span::{Ending, Span};
use crate::integrator::EnergyScale;

/// Runs that take less time in all than this are repeated, as often as that allows but …
const LEAST_SECONDS: f64 = 0.5;
/// … at most so often: times of short runs scatter.
const MOST_RUNS: usize = 7;

/// What a run leaves.
#[derive(Debug)]
pub(super) struct Outcome {
    /// The initial state.
    pub start: Frame,
    /// What errors of the energy are relative to.
    pub energy_scale: EnergyScale,
    /// States at the times of comparison.
    pub frames: [Frame; 2],
    pub nodes: usize,
    pub steps: u64,
    pub seconds: f64,
}

/// `scene` at another tolerance and on other nodes, to the end of `span` and with frames at its times only.
pub(super) fn rung(scene: &Scene, tolerance: f64, nodes: Nodes, span: &Span) -> Scene {
    let mut rung = scene.clone();
    rung.accuracy.tolerance = tolerance;
    rung.accuracy.nodes = nodes;
    rung.time.end = span.end;
    rung.time.stop_at_equilibrium = false;
    rung.flow.stop_on_contact = false;
    rung.output = Output { frames: Frames::At { times: vec![span.halfway] }, fields: Vec::new() };
    rung.renewed()
}

/// Runs the scene of [`rung`] once.
pub(super) fn once(scene: &Scene, observer: &mut dyn Observer) -> Result<Outcome, RunError> {
    let mut record = run(scene, observer)?;
    ending(&record, scene.time.end)?;
    let (nodes, counters) = (record.nodes(), record.counters);
    let energy_scale = energy_scale(scene, &record);
    let [start, .., halfway, end] = record.frames.as_mut_slice() else {
        unreachable!("a run that reached its end has saved three frames");
    };
    Ok(Outcome {
        start: std::mem::take(start),
        energy_scale,
        frames: [std::mem::take(halfway), std::mem::take(end)],
        nodes,
        steps: counters.steps,
        seconds: counters.integration_seconds,
    })
}

/// Runs it, and again while that is quick; the seconds are the median.
pub(super) fn timed(scene: &Scene, observer: &mut dyn Observer) -> Result<Outcome, RunError> {
    let outcome = once(scene, observer)?;
    let mut seconds = vec![outcome.seconds];
    // An odd number of runs has a run in the middle.
    while seconds.len() < MOST_RUNS && seconds.iter().sum::<f64>() + 2.0 * outcome.seconds < LEAST_SECONDS {
        for _ in 0..2 {
            seconds.push(once(scene, observer)?.seconds);
        }
    }
    seconds.sort_by(f64::total_cmp);
    Ok(Outcome { seconds: seconds[seconds.len() / 2], ..outcome })
}

/// Where a run came to an end, if it did: at `end` or where its scene stops.
pub(super) fn ending(record: &Record, end: f64) -> Result<Ending, RunError> {
    match &record.stop_reason {
        StopReason::EndTime => Ok(Ending::EndTime),
        StopReason::Equilibrium => Ok(Ending::Equilibrium),
        StopReason::Contact => Ok(Ending::Contact),
        StopReason::Interrupted => Err(RunError::Interrupted),
        StopReason::Failed(message) => {
            let time = record.frames.last().map_or(0.0, |frame| frame.time);
            Err(RunError::Failed { time, end, message: message.clone() })
        }
    }
}
