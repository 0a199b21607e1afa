//! A measured ladder as text, and as JSON.

use std::fmt::Write;

use flow_core::run::tradeoff::{Errors, Rung, Tradeoff};
use serde_json::{Map, Value, json};

use crate::print::{counted, number};

/// What was compared with what, in one line.
pub fn scope(measured: &Tradeoff) -> String {
    let (span, reference) = (measured.span, measured.reference);
    let in_time_only: Vec<String> =
        measured.in_time_only().map(|tolerance| format!("{tolerance:e}")).collect();
    let scope = if in_time_only.is_empty() {
        "errors in time and space".to_owned()
    } else if in_time_only.len() == measured.rungs().count() {
        "errors in time only (--reference-nodes adds those of the nodes)".to_owned()
    } else {
        let tolerances = in_time_only.join(", ");
        format!(
            "errors in time and space, but in time only at {tolerances} (--reference-nodes adds those of the nodes)"
        )
    };
    let rounding = if reference.at_rounding {
        "; the reference cannot be tighter, so errors near its tolerance are not resolved"
    } else {
        ""
    };
    format!(
        "compared at t = {:.6e}, where half of the energy is lost, and t = {:.6e} ({}) with a run at tolerance {:e} on {} \
         nodes ({}, {} s): {scope}{rounding}",
        span.halfway,
        span.end,
        span.ending.name(),
        reference.tolerance,
        reference.nodes,
        counted(reference.steps, "step"),
        digits(reference.seconds)
    )
}

/// A line per run: the tolerance asked for, the largest error, and the larger of both times for each quantity.
pub fn table(measured: &Tradeoff, error: Option<f64>) -> String {
    let quantities = names(measured);
    let head = ["asked", "got"].into_iter().chain(quantities.iter().copied());
    let head: Vec<String> = head.chain(["nodes", "steps", "seconds"]).map(str::to_owned).collect();
    let lines: Vec<(Vec<String>, Option<String>)> = measured
        .rows
        .iter()
        .map(|row| match &row.outcome {
            Ok(rung) => (cells(measured, row.tolerance, rung), None),
            Err(failure) => (vec![format!("{:e}", row.tolerance)], Some(failure.to_string())),
        })
        .collect();
    let width = |column: usize| {
        let cells = lines.iter().filter_map(|(cells, _)| cells.get(column)).chain(head.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let line = |cells: &[String]| -> String {
        let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
        padded.collect::<Vec<_>>().join("  ")
    };
    let mut text = line(&head);
    for (cells, failure) in &lines {
        let _ = write!(text, "\n{}", line(cells)); // a String never fails
        if let Some(failure) = failure {
            let _ = write!(text, "  {failure}");
        }
    }
    if let Some((error, (tolerance, rung))) = error.and_then(|error| Some((error, measured.cheapest(error)?)))
    {
        let _ = write!(
            text,
            "\ncheapest for {error:e}: accuracy.tolerance = {tolerance:e} with {} nodes, error {:.1e}, {} s",
            rung.nodes,
            rung.largest_error(),
            digits(rung.seconds)
        );
    }
    text
}

fn cells(measured: &Tradeoff, tolerance: f64, rung: &Rung) -> Vec<String> {
    let [halfway, end] = rung.errors.each_ref().map(|errors| values(measured, errors));
    let larger = halfway.iter().zip(&end).map(|(a, b)| if a.is_nan() || a > b { *a } else { *b });
    let errors = [rung.largest_error()].into_iter().chain(larger).map(|error| format!("{error:.1e}"));
    let cost = [rung.nodes.to_string(), rung.steps.to_string(), digits(rung.seconds)];
    [format!("{tolerance:e}")].into_iter().chain(errors).chain(cost).collect()
}

fn names(measured: &Tradeoff) -> Vec<&str> {
    let densities = measured.densities.iter().map(String::as_str);
    ["curve", "curvature"].into_iter().chain(densities).chain(["energy", "length"]).collect()
}

fn values(measured: &Tradeoff, errors: &Errors) -> Vec<f64> {
    errors.named(&measured.densities).map(|(_, error)| error).collect()
}

/// Three digits, without an exponent.
fn digits(seconds: f64) -> String {
    let decimals = if seconds > 0.0 { (2.0 - seconds.log10().floor()).max(0.0) } else { 0.0 };
    format!("{seconds:.*}", decimals as usize)
}

/// All that was measured, errors at both times.
pub fn json(measured: &Tradeoff, error: Option<f64>) -> String {
    let (span, reference) = (measured.span, measured.reference);
    let rows: Vec<Value> = measured
        .rows
        .iter()
        .map(|row| match &row.outcome {
            Ok(rung) => setting(measured, row.tolerance, rung),
            Err(failure) => failed(row.tolerance, &failure.to_string()),
        })
        .collect();
    let cheapest = error.and_then(|error| measured.cheapest(error));
    let value = json!({
        "title": measured.title,
        "times": { "halfway": span.halfway, "end": span.end, "ending": span.ending.name() },
        "reference": {
            "tolerance": reference.tolerance,
            "at_rounding": reference.at_rounding,
            "nodes": reference.nodes,
            "steps": reference.steps,
            "seconds": reference.seconds,
        },
        "includes_space": measured.includes_space(),
        "rows": rows,
        "cheapest": cheapest.map(|(tolerance, rung)| setting(measured, tolerance, rung)),
    });
    format!("{value:#}")
}

fn setting(measured: &Tradeoff, tolerance: f64, rung: &Rung) -> Value {
    let errors = |errors: &Errors| -> Map<String, Value> {
        errors.named(&measured.densities).map(|(name, error)| (name.to_owned(), number(error))).collect()
    };
    let [halfway, end] = &rung.errors;
    json!({
        "tolerance": tolerance,
        "failure": null,
        "includes_space": measured.includes_space_of(rung),
        "error": number(rung.largest_error()),
        "nodes": rung.nodes,
        "steps": rung.steps,
        "seconds": rung.seconds,
        "errors": { "halfway": errors(halfway), "end": errors(end) },
    })
}

/// A run without a result, with the keys of one that has.
fn failed(tolerance: f64, failure: &str) -> Value {
    json!({
        "tolerance": tolerance,
        "failure": failure,
        "includes_space": null,
        "error": null,
        "nodes": null,
        "steps": null,
        "seconds": null,
        "errors": null,
    })
}
