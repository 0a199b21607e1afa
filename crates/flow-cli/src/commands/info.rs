//! `curveflow info OUT`: what a result file holds.

use std::fmt::Write;
use std::path::PathBuf;

use flow_core::run::{Provenance, Record, Rejections, Share, StopReason, WhySlow, warnings};
use serde_json::{Map, Value, json};

use super::so_far::run_so_far;
use crate::error::CliError;
use crate::print::{self, harmless, number};

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
    let rows = summary(&record);
    let why = WhySlow::of(&record);
    print::data(&if args.json {
        as_json(rows.into_iter().chain(time_rows(&why)).collect())
    } else {
        format!("{}\n\n{why}", as_table(&rows))
    })
}

/// The summary of a record as JSON.
pub fn json(record: &Record) -> String {
    as_json(summary(record).into_iter().chain(time_rows(&WhySlow::of(record))).collect())
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

/// Key and value of every line, in order.
fn summary(record: &Record) -> Vec<(String, Value)> {
    let mut rows: Vec<(String, Value)> = Vec::new();
    let mut row = |key: &str, value: Value| rows.push((key.to_owned(), value));
    row("title", json!(record.title));
    row("stop_reason", json!(record.stop_reason.name()));
    if let StopReason::Failed(message) = &record.stop_reason {
        row("message", json!(message));
    }
    let doubts = warnings(record);
    if !doubts.is_empty() {
        row("warnings", json!(doubts));
    }
    if !record.own_terms.is_empty() {
        row("own_terms", json!(record.own_terms));
    }
    row("frames", json!(record.frames.len()));
    row("nodes", json!(record.nodes()));
    if let (Some(first), Some(last)) = (record.frames.first(), record.frames.last()) {
        row("time", number(last.time));
        row("energy_first", number(first.energy));
        row("energy_last", number(last.energy));
        row("dissipation_last", number(last.dissipation));
        row("energy_balance", number(last.energy_balance));
        row("length_first", number(first.length));
        row("length_last", number(last.length));
        row("crossings_last", number(last.crossings));
        let changes = record.frames.windows(2).filter(|pair| pair[0].crossings != pair[1].crossings);
        let events: Vec<Value> = changes
            .map(|pair| {
                let (before, now) = (pair[0].crossings, pair[1].crossings);
                json!(format!("{before} → {now} crossings between t = {} and {}", pair[0].time, pair[1].time))
            })
            .collect();
        if !events.is_empty() {
            row("events", json!(events));
        }
        for (i, name) in record.densities.iter().enumerate() {
            row(&format!("mass_{name}"), number(last.mass[i]));
            row(&format!("mass_drift_{name}"), number(relative_change(first.mass[i], last.mass[i])));
        }
    }
    let counters = &record.counters;
    row("steps", json!(counters.steps));
    row("right_hand_sides", json!(counters.right_hand_sides));
    row("jacobian_products", json!(counters.jacobian_products));
    row("newton_iterations", json!(counters.newton_iterations));
    row("krylov_iterations", json!(counters.krylov_iterations));
    row("factorisations", json!(counters.factorisations));
    row("solves", json!(counters.solves));
    if counters.remaps > 0 {
        row("remaps", json!(counters.remaps));
        row("remap_error", number(record.frames.last().map_or(0.0, |last| last.remap_error)));
    }
    if counters.unresolved_steps > 0 {
        row("unresolved_steps", json!(counters.unresolved_steps));
    }
    let Rejections { error, solver, energy_rise, not_finite } = counters.rejections;
    row("rejections_error", json!(error));
    row("rejections_solver", json!(solver));
    row("rejections_energy_rise", json!(energy_rise));
    row("rejections_not_finite", json!(not_finite));
    row("integration_seconds", number(counters.integration_seconds));
    let Provenance { version, commit, machine, .. } = &record.provenance;
    row("curveflow_version", json!(version));
    row("commit", json!(commit.as_deref().unwrap_or("unknown")));
    row("machine", json!(machine));
    rows
}

/// Change from `first` to `last`, relative to `first` unless that is zero.
fn relative_change(first: f64, last: f64) -> f64 {
    if first == 0.0 { last } else { (last - first) / first.abs() }
}

fn as_json(rows: Vec<(String, Value)>) -> String {
    format!("{:#}", Value::Object(rows.into_iter().collect::<Map<_, _>>()))
}

fn as_table(rows: &[(String, Value)]) -> String {
    let width = rows.iter().map(|(key, _)| key.chars().count()).max().unwrap_or(0);
    let mut table = String::new();
    for (key, value) in rows {
        let text = value.as_str().map_or_else(|| value.to_string(), harmless);
        let _ = writeln!(table, "{key:width$}  {text}"); // a String never fails
    }
    table.truncate(table.trim_end().len());
    table
}
