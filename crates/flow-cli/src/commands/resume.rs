//! `curveflow resume OUT.h5`: go on with a run that was stopped.

use std::path::{Path, PathBuf};

use flow_core::output::StorageError;
use flow_core::output::atomic_file::check_writable;
use flow_core::output::checkpoint::{Found, Pair, check_way};
use flow_core::run::{Record, StopReason};

use super::conduct::{Conduct, Outset, say_doubts};
use super::info;
use super::standing::Standing;
use crate::error::CliError;
use crate::print::{self, counted};

/// Go on with a run that was stopped, from its checkpoint.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Result file of the run; the checkpoints lie beside it.
    #[arg(value_name = "OUT.h5")]
    pub output: PathBuf,
    #[command(flatten)]
    pub conduct: Conduct,
}

/// Goes on to the end of the run.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let outset = Outset::now()?;
    let mut pair = Pair::beside(&args.output);
    match Standing::of(&mut pair)? {
        Standing::Stopped(found, _lock) => go_on(&args.conduct, outset, *found, pair),
        Standing::Over(record) => already_done(&args.conduct, &record, &args.output),
        Standing::Nothing(_) => Err(StorageError::NoCheckpoint { path: args.output.clone() }.into()),
    }
}

/// Goes on from what was found.
pub fn go_on(conduct: &Conduct, outset: Outset, found: Found, pair: Pair) -> Result<(), CliError> {
    check_way(&pair, &found.checkpoint)?;
    check_writable(pair.result(), true)?;
    if let Some(damaged) = &found.damaged {
        print::talk(&format!(
            "warning: {damaged}; going on from the other checkpoint, {}",
            found.path.display()
        ));
    }
    if !conduct.quiet {
        let memory = &found.checkpoint.memory;
        print::talk(&format!(
            "going on at t = {:.6e}, after {}",
            memory.time(),
            counted(memory.steps(), "step")
        ));
    }
    let simulation = found.checkpoint.simulation(&found.path)?;
    conduct.run(outset, simulation, pair, true)
}

/// Says how the run of `record` ended, without a checkpoint to go on from.
pub fn already_done(conduct: &Conduct, record: &Record, output: &Path) -> Result<(), CliError> {
    let path = output.to_path_buf();
    match &record.stop_reason {
        StopReason::Interrupted => return Err(StorageError::NoCheckpoint { path }.into()),
        StopReason::Failed(message) => {
            return Err(CliError::Numerical { message: message.clone(), output: path });
        }
        _ => {}
    }
    if conduct.json {
        print::data(&info::json(record, output))?;
    } else if !conduct.quiet {
        print::talk(&format!("nothing to do: {}", record.stop_reason.message()));
        say_doubts(record);
        print::data(&output.display().to_string())?;
    }
    Ok(())
}
