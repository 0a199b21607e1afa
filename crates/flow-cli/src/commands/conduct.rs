//! Takes a run to its end, with checkpoints beside its result file, and says how it went.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use flow_core::output::checkpoint::{Ended, Pair, Saving, run_saving};
use flow_core::output::{StorageError, hdf5_file};
use flow_core::run::{Record, Simulation, StopReason, warnings};

use super::info;
use crate::error::CliError;
use crate::print::{self, counted, digits};
use crate::progress::Reporter;
use crate::signals::stop_flag;

/// How a run is watched and saved.
#[derive(Debug, clap::Args)]
pub struct Conduct {
    /// Seconds between two checkpoints, which are written beside the result file until that is done.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    pub checkpoint: Duration,
    /// Stop this time after the start of the command, with a checkpoint (exit code 6).
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub max_wall: Option<Duration>,
    /// Print the summary as JSON.
    #[arg(long)]
    pub json: bool,
    /// Show no progress and print no summary.
    #[arg(short, long)]
    pub quiet: bool,
}

/// When a command began, and whether somebody has wanted it to stop since.
#[derive(Debug)]
pub struct Outset {
    began: Instant,
    stop: Arc<AtomicBool>,
}

impl Outset {
    /// To be called first: setting up a scene takes time, and signals may come.
    pub fn now() -> Result<Self, CliError> {
        Ok(Self { began: Instant::now(), stop: stop_flag()? })
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let wrong = || format!("`{text}` is not a time in seconds from 0 to 1.8e19; try 60");
    let value: f64 = text.parse().map_err(|_| wrong())?;
    Duration::try_from_secs_f64(value).map_err(|_| wrong())
}

impl Conduct {
    /// Runs `simulation`; its result goes to the file of `pair`, also if the run fails or is stopped, and its checkpoints
    /// go once it is done.
    pub fn run(
        &self,
        outset: Outset,
        simulation: Simulation,
        pair: Pair,
        replace: bool,
    ) -> Result<(), CliError> {
        let Outset { began, stop } = outset;
        // A time that the clock cannot tell is never reached.
        let limit = self.max_wall.and_then(|limit| began.checked_add(limit));
        let mut reporter = Reporter::new(self.quiet, stop, limit);
        let mut warn = self.once_each(reporter.voice());
        let mut saving = Saving { pair, interval: self.checkpoint, missed: &mut warn };
        let mut ended = run_saving(simulation, &mut reporter, &mut saving);
        reporter.finish();
        if saving.pair.is_of_another_run() {
            // Between the result and the end of those checkpoints somebody might go on from them. If this fails, they only go later.
            drop(ended.save(&mut saving.pair));
        }
        let output = saving.pair.result().to_path_buf();
        if let Err(reason) = hdf5_file::write_timed(&mut ended.record, saving.pair.target(), replace) {
            return Err(unwritten(reason, &ended, &mut saving));
        }
        let Ended { record, last, goes_on, .. } = ended;
        let stopped = record.stop_reason == StopReason::Interrupted;
        // Without a checkpoint of its own it does not.
        let goes_on = goes_on && !saving.pair.is_of_another_run();
        let removed = if goes_on { Ok(()) } else { saving.pair.remove() };
        let seconds = began.elapsed().as_secs_f64();
        if self.json {
            print::data(&info::json(&record, &output))?;
        } else if !self.quiet {
            print::talk(&closing_line(&record, seconds));
            say_doubts(&record);
            print::data(&output.display().to_string())?;
        }
        if stopped && let Some(Err(error)) = last {
            return Err(error.into());
        }
        removed?;
        outcome(record, goes_on && !matches!(last, Some(Err(_))), &output)
    }

    /// Says why a checkpoint is missing, each reason once.
    fn once_each(&self, say: impl Fn(&str)) -> impl FnMut(StorageError) {
        let seconds = self.checkpoint.as_secs_f64();
        let mut said: Vec<StorageError> = Vec::new();
        move |error| {
            if !said.iter().any(|earlier| earlier.is_like(&error)) {
                say(&format!(
                    "warning: {error}; the run goes on without this checkpoint, and tries the next one in {seconds} s"
                ));
                said.push(error);
            }
        }
    }
}

/// What to say of a result that could not be written: whether its run is saved, or can be now, or was on the way.
fn unwritten(reason: StorageError, ended: &Ended, saving: &mut Saving) -> CliError {
    let saved =
        matches!(ended.last, Some(Ok(()))) || ended.save(&mut saving.pair).is_ok() || saving.pair.holds_own();
    let output = saving.pair.result().to_path_buf();
    match reason {
        // To replace the file that has come there meanwhile is to throw the run away.
        StorageError::Exists { path } if saved => StorageError::InTheWay { path }.into(),
        reason if saved => CliError::Unwritten { reason, output },
        reason => CliError::Lost(reason),
    }
}

fn outcome(record: Record, goes_on: bool, output: &Path) -> Result<(), CliError> {
    let time = record.frames.last().map_or(0.0, |frame| frame.time);
    let output = output.to_path_buf();
    match record.stop_reason {
        StopReason::EndTime | StopReason::Equilibrium | StopReason::Contact => Ok(()),
        StopReason::Interrupted => Err(CliError::Stopped { time, output }),
        StopReason::Failed(message) if goes_on => Err(CliError::UsedUp { message, output }),
        StopReason::Failed(message) => Err(CliError::Numerical { message, output }),
    }
}

/// Says what makes the result doubtful.
pub fn say_doubts(record: &Record) {
    for warning in warnings(record) {
        print::talk(&format!("warning: {warning}"));
    }
}

fn closing_line(record: &Record, seconds: f64) -> String {
    let (Some(first), Some(last)) = (record.frames.first(), record.frames.last()) else {
        return String::new();
    };
    let ending = match &record.stop_reason {
        StopReason::Equilibrium => "at equilibrium",
        StopReason::EndTime => "end time reached",
        StopReason::Contact => "in contact with itself",
        StopReason::Interrupted => "interrupted",
        StopReason::Failed(_) => "failed",
    };
    format!(
        "{ending}: t = {:.6e}, energy {} → {}, length {} → {}; {} nodes, {}, {:.3} s ({:.3} s integration)",
        last.time,
        digits(first.energy),
        digits(last.energy),
        digits(first.length),
        digits(last.length),
        record.nodes(),
        counted(record.counters.steps, "step"),
        seconds,
        // Counters hold those before a restart too, which are no part of the seconds of this command.
        record.seconds.in_steps(),
    )
}

#[cfg(test)]
mod tests {
    use flow_core::run::{Quiet, Scene, run};

    use super::*;

    #[test]
    fn the_integration_is_no_more_than_the_command_took() {
        let (name, text) = Scene::shipped()[0];
        let mut record = run(&Scene::parse(text, name).unwrap(), &mut Quiet).unwrap();
        record.counters.integration_seconds += 1e6; // of a run that was resumed
        let line = closing_line(&record, 1e3);
        let part = line.split(" s (").nth(1).and_then(|rest| rest.split(" s integration").next()).unwrap();
        assert!(part.parse::<f64>().unwrap() < 1e3, "{line}");
    }
}
