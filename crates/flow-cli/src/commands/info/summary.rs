//! How a run ended, what it kept and what it cost: keys and values, in the order of the table.

use flow_core::run::{Frame, Provenance, Record, Rejections, StopReason, warnings};
use serde_json::{Value, json};

use crate::print::{count, number};

/// Key and value of every line. Keys are there whether or not there is something to tell, as programs expect.
pub fn rows(record: &Record) -> Vec<(String, Value)> {
    let rows = ending(record).into_iter().chain(states(record));
    let named = rows.map(|(key, value)| (key.to_owned(), value));
    let work = work(record).into_iter().chain(origin(record)).map(|(key, value)| (key.to_owned(), value));
    named.chain(masses(record)).chain(work).collect()
}

fn ending(record: &Record) -> Vec<(&'static str, Value)> {
    vec![
        ("title", json!(record.title)),
        ("success", json!(record.stop_reason.is_success())),
        ("stop_reason", json!(record.stop_reason.name())),
        ("message", json!(record.stop_reason.message())),
        ("warnings", json!(warnings(record))),
        ("own_terms", json!(record.own_terms)),
    ]
}

fn states(record: &Record) -> Vec<(&'static str, Value)> {
    let of = |frame: Option<&Frame>, value: fn(&Frame) -> f64| {
        frame.map_or(Value::Null, |frame| number(value(frame)))
    };
    let (first, last) = (record.frames.first(), record.frames.last());
    vec![
        ("frames", json!(record.frames.len())),
        ("nodes", json!(record.nodes())),
        ("time", of(last, |frame| frame.time)),
        ("energy_first", of(first, |frame| frame.energy)),
        ("energy_last", of(last, |frame| frame.energy)),
        ("dissipation_last", of(last, |frame| frame.dissipation)),
        ("energy_balance", of(last, |frame| frame.energy_balance)),
        ("length_first", of(first, |frame| frame.length)),
        ("length_last", of(last, |frame| frame.length)),
        ("crossings_last", last.map_or(Value::Null, |frame| count(frame.crossings))),
        ("events", json!(events(record))),
    ]
}

/// Changes of the number of self-crossings, and the contact that ended the run.
fn events(record: &Record) -> Vec<String> {
    let changes = record.frames.windows(2).filter(|pair| pair[0].crossings != pair[1].crossings);
    let told = |pair: &[Frame]| {
        let (before, now) = (pair[0].crossings, pair[1].crossings);
        format!("{before} → {now} crossings between t = {} and {}", pair[0].time, pair[1].time)
    };
    let ended = record.frames.last().filter(|_| record.stop_reason == StopReason::Contact);
    changes.map(told).chain(ended.map(|last| format!("contact at t = {}", last.time))).collect()
}

fn masses(record: &Record) -> Vec<(String, Value)> {
    let of_density = |(k, name): (usize, &String)| {
        let mass = record.frames.last().map_or(Value::Null, |frame| number(frame.mass[k]));
        let drift = record.mass_changes(k).last().map_or(Value::Null, |drift| number(*drift));
        [(format!("mass_{name}"), mass), (format!("mass_drift_{name}"), drift)]
    };
    record.densities.iter().enumerate().flat_map(of_density).collect()
}

fn work(record: &Record) -> Vec<(&'static str, Value)> {
    let counters = &record.counters;
    let Rejections { error, solver, energy_rise, not_finite } = counters.rejections;
    vec![
        ("steps", json!(counters.steps)),
        ("right_hand_sides", json!(counters.right_hand_sides)),
        ("jacobian_products", json!(counters.jacobian_products)),
        ("newton_iterations", json!(counters.newton_iterations)),
        ("krylov_iterations", json!(counters.krylov_iterations)),
        ("factorisations", json!(counters.factorisations)),
        ("solves", json!(counters.solves)),
        ("remaps", json!(counters.remaps)),
        ("remap_error", number(record.frames.last().map_or(0.0, |last| last.remap_error))),
        ("unresolved_steps", json!(counters.unresolved_steps)),
        ("rejections_error", json!(error)),
        ("rejections_solver", json!(solver)),
        ("rejections_energy_rise", json!(energy_rise)),
        ("rejections_not_finite", json!(not_finite)),
        ("integration_seconds", number(counters.integration_seconds)),
    ]
}

fn origin(record: &Record) -> Vec<(&'static str, Value)> {
    let Provenance { version, commit, machine, .. } = &record.provenance;
    vec![
        ("curveflow_version", json!(version)),
        ("commit", json!(commit.as_deref().unwrap_or("unknown"))),
        ("machine", json!(machine)),
    ]
}
