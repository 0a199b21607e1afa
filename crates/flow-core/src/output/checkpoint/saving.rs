//! Runs a simulation and saves it on the way.

use std::time::{Duration, Instant};

use super::pair::Pair;
use crate::output::StorageError;
use crate::run::{Memory, Observer, Record, Simulation, Spending};

/// Saving takes at most this part of the time.
const SHARE: u32 = 20;

/// When and where a run is saved.
pub struct Saving<'a> {
    /// The files.
    pub pair: Pair,
    /// Time between two checkpoints, at least; longer if writing them takes long.
    pub interval: Duration,
    /// Told why a checkpoint could not be written: the run goes on, and the next one is tried when it is due.
    pub missed: &'a mut dyn FnMut(StorageError),
}

/// A run that has ended, or was stopped.
#[derive(Debug)]
pub struct Ended {
    /// What there is of it.
    pub record: Record,
    /// What it takes to go on, or to make the record again.
    memory: Memory,
    /// Whether it is not over: it was stopped, or has used up its steps, and goes on from its checkpoint.
    pub goes_on: bool,
    /// Whether a checkpoint of its end was written; none if it is over and was too short to have any.
    pub last: Option<Result<(), StorageError>>,
}

impl Ended {
    /// Saves the run that is over in `pair`, so that its result can be written later.
    ///
    /// # Errors
    /// As for [`Pair::write`].
    pub fn save(&self, pair: &mut Pair) -> Result<(), StorageError> {
        pair.write_ended(&self.record, &self.memory)
    }
}

/// Takes the steps of `simulation` to its end, or until `observer` stops it, with a checkpoint now and then. There is one of the end
/// too if the run can go on, or took longer than the time between two: making its result may take more memory than there is. The
/// checkpoints stay: remove them once the record is safe.
pub fn run_saving(mut simulation: Simulation, observer: &mut dyn Observer, saving: &mut Saving) -> Ended {
    let started = Instant::now();
    let (mut saved, mut interval) = (started, saving.interval);
    let mut output = Duration::ZERO;
    while simulation.step(observer) {
        if saved.elapsed() >= interval {
            let clock = Instant::now();
            saving.pair.write(&simulation).unwrap_or_else(&mut *saving.missed);
            let taken = clock.elapsed();
            output += taken;
            interval = saving.interval.max(SHARE * taken);
            saved = Instant::now();
        }
    }
    let goes_on = simulation.can_go_on();
    let clock = Instant::now();
    let last = (goes_on || started.elapsed() >= saving.interval).then(|| saving.pair.write(&simulation));
    output += clock.elapsed();
    let memory = simulation.memory();
    let mut record = simulation.into_record();
    record.seconds[Spending::Output] += output.as_secs_f64();
    Ended { record, memory, goes_on, last }
}
