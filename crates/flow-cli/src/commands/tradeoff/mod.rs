//! `curveflow tradeoff SCENE`: measure the error of a ladder of tolerances against the time that they take.

mod figure;
mod report;

use flow_core::run::tradeoff::{Ladder, Tradeoff, tradeoff};

use super::scene_args::SceneArgs;
use crate::error::CliError;
use crate::print;
use crate::progress::Reporter;
use crate::signals::stop_flag;
use figure::FigureArgs;

/// Measure true errors against time for a ladder of tolerances; print the table and draw it.
#[derive(Debug, clap::Args)]
pub struct Args {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Tolerances to run, in any order [default: 1e-2, 1e-3 … 1e-8].
    #[arg(long, value_name = "1e-3,1e-5,…", value_delimiter = ',')]
    pub tolerances: Option<Vec<f64>>,
    /// Number of nodes of the reference, so that the error of the nodes is measured too [default: those of the scene; as
    /// many as its tolerance needs where they are "auto"].
    #[arg(long, value_name = "N")]
    pub reference_nodes: Option<usize>,
    /// Name the quickest run with at most this error.
    #[arg(long, value_name = "ERROR")]
    pub error: Option<f64>,
    #[command(flatten)]
    pub figure: FigureArgs,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Runs the ladder. What was measured is printed and drawn also if a run fails or a signal stops it.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let ladder = ladder(args)?;
    let scene = args.scene.read()?;
    let path = args.figure.path(args.scene.named("_tradeoff.png"), args.json)?;
    let mut reporter = Reporter::new(args.quiet, stop_flag()?, None);
    let measured = tradeoff(&scene, &ladder, &mut reporter);
    reporter.finish();
    let measured = measured?;
    if !args.quiet {
        print::talk(&report::scope(&measured));
    }
    print::data(&if args.json {
        report::json(&measured, args.error)
    } else {
        report::table(&measured, args.error)
    })?;
    if let Some(path) = path.filter(|_| measured.rungs().next().is_some()) {
        args.figure.draw(&measured, &path)?;
        if !args.quiet {
            print::talk(&path.display().to_string());
        }
    }
    verdict(&measured, args.error)
}

fn ladder(args: &Args) -> Result<Ladder, CliError> {
    let default = Ladder::default();
    let tolerances = args.tolerances.as_deref().unwrap_or(default.tolerances());
    let ladder = Ladder::new(tolerances, args.reference_nodes);
    match args.error {
        Some(error) if !(error > 0.0 && error.is_finite()) => {
            Err(CliError::Usage { message: format!("--error {error} must be positive and finite; try 1e-4") })
        }
        _ => ladder.map_err(|error| CliError::Usage { message: error.to_string() }),
    }
}

/// Whether the ladder answers what was asked.
fn verdict(measured: &Tradeoff, error: Option<f64>) -> Result<(), CliError> {
    if measured.is_interrupted() {
        return Err(CliError::LadderStopped { measured: measured.rungs().count() });
    }
    let best = measured.rungs().min_by(|(_, a), (_, b)| a.largest_error().total_cmp(&b.largest_error()));
    let Some((tolerance, best)) = best else { return Err(CliError::AllFailed) };
    match error {
        Some(asked) if measured.cheapest(asked).is_none() => {
            Err(CliError::NotReached { asked, least: best.largest_error(), tolerance })
        }
        _ => Ok(()),
    }
}
