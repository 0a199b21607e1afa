//! `curveflow info OUT`: what a result file holds.

mod summary;
mod table;

use std::path::{Path, PathBuf};

use flow_core::run::{Record, Share, WhySlow};
use serde_json::{Map, Value, json};

use super::so_far::run_so_far;
use crate::error::CliError;
use crate::print::{self, number};

/// Show how a run ended, what it conserved and what it cost.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Result file of `curveflow run`.
    pub out: PathBuf,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
}

/// Prints the summary.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let record = run_so_far(&args.out)?;
    print::data(&if args.json {
        json(&record, &args.out)
    } else {
        format!("{}\n\n{}", table::table(&summary::rows(&record)), WhySlow::of(&record))
    })
}

/// The summary of the record of the file `output` as JSON. Every record has the same keys, but for its densities and terms.
pub fn json(record: &Record, output: &Path) -> String {
    let file = ("output".to_owned(), json!(output.display().to_string()));
    let rows = summary::rows(record).into_iter().chain([file]).chain(time_rows(&WhySlow::of(record)));
    format!("{:#}", Value::Object(rows.collect::<Map<_, _>>()))
}

/// Where the time went and why, for programs.
fn time_rows(why: &WhySlow) -> Vec<(String, Value)> {
    let seconds = |shares: &[Share]| {
        let entries = shares.iter().map(|share| (share.name.clone(), number(share.seconds)));
        Value::Object(entries.collect())
    };
    [
        ("krylov_iterations_per_solve", number(why.krylov_iterations_per_solve)),
        ("seconds_total", number(why.total)),
        ("seconds", seconds(&why.activities)),
        ("evaluation_seconds", seconds(&why.evaluations)),
        ("limit", json!(why.limit.name())),
        ("why_slow", json!(why.sentence)),
        ("advice", json!(why.advice)),
    ]
    .map(|(key, value)| (key.to_owned(), value))
    .into()
}
