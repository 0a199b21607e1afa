//! `curveflow run SCENE`: integrate one scene and write its result file.

use std::path::PathBuf;
use std::time::Instant;

use flow_core::output::atomic_file::check_writable;
use flow_core::output::hdf5_file;
use flow_core::run::{Record, StopReason, run};

use super::info;
use super::scene_args::SceneArgs;
use crate::error::CliError;
use crate::print;
use crate::progress::Reporter;
use crate::signals::stop_flag;

/// Integrate a scene and write its result file.
#[derive(Debug, clap::Args)]
pub struct Args {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Result file to write [default: the scene's name with .h5, in the current folder].
    #[arg(short, long, value_name = "OUT.h5")]
    pub output: Option<PathBuf>,
    /// Replace an existing result file.
    #[arg(long)]
    pub replace: bool,
    /// Print the summary as JSON.
    #[arg(long)]
    pub json: bool,
    /// Show no progress and print no summary.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Runs the scene. What was computed is written also if the run fails or is stopped.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let scene = args.scene.read()?;
    let output = args.output.clone().unwrap_or_else(|| args.scene.stem().with_extension("h5"));
    check_writable(&output, args.replace)?;
    let clock = Instant::now();
    let mut reporter = Reporter::new(args.quiet, stop_flag()?);
    let record =
        run(&scene, &mut reporter).map_err(|error| CliError::InvalidScene { source: Box::new(error) })?;
    reporter.finish();
    hdf5_file::write(&record, &output, args.replace)?;
    let seconds = clock.elapsed().as_secs_f64();
    if args.json {
        print::data(&info::json(&record))?;
    } else if !args.quiet {
        print::talk(&closing_line(&record, seconds));
        print::data(&output.display().to_string())?;
    }
    let time = record.frames.last().map_or(0.0, |frame| frame.time);
    match record.stop_reason {
        StopReason::EndTime | StopReason::Equilibrium | StopReason::Contact => Ok(()),
        StopReason::Interrupted => Err(CliError::Stopped { time, output }),
        StopReason::Failed(message) => Err(CliError::Numerical { message, output }),
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
        "{ending}: t = {:.6e}, energy {:.6} → {:.6}, length {:.6} → {:.6}; {} nodes, {} steps, {:.3} s ({:.3} s \
         integration)",
        last.time,
        first.energy,
        last.energy,
        first.length,
        last.length,
        record.nodes(),
        record.counters.steps,
        seconds,
        record.counters.integration_seconds,
    )
}
