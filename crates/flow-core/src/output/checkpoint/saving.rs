//! Runs a simulation and saves it on the way.

use std::time::{Duration, Instant};

use super::pair::Pair;
use crate::output::StorageError;
use crate::run::{Observer, Record, Simulation, StopReason};

/// Saving takes at most this part of the time.
const SHARE: u32 = 20;

/// When and where a run is saved.
#[derive(Debug)]
pub struct Saving {
    /// The files.
    pub pair: Pair,
    /// Time between two checkpoints, at least; longer if writing them takes long.
    pub interval: Duration,
}

/// Takes the steps of `simulation` to its end, or until `observer` stops it, with a checkpoint now and then, and one at the
/// end of an interrupted run. The checkpoints stay: remove them once the record is safe.
///
/// # Errors
/// [`StorageError`] if a checkpoint cannot be written; the last one that could stays whole.
pub fn run_saving(
    mut simulation: Simulation,
    observer: &mut dyn Observer,
    saving: &mut Saving,
) -> Result<Record, StorageError> {
    let (mut saved, mut interval) = (Instant::now(), saving.interval);
    let mut output = Duration::ZERO;
    while simulation.step(observer) {
        if saved.elapsed() >= interval {
            let clock = Instant::now();
            saving.pair.write(&simulation)?;
            let taken = clock.elapsed();
            output += taken;
            interval = saving.interval.max(SHARE * taken);
            saved = Instant::now();
        }
    }
    if simulation.stop_reason() == Some(&StopReason::Interrupted) {
        let clock = Instant::now();
        saving.pair.write(&simulation)?;
        output += clock.elapsed();
    }
    let mut record = simulation.into_record();
    record.seconds.output += output.as_secs_f64();
    Ok(record)
}
