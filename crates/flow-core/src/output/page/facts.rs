//! What a run kept, how it ended and what it cost, as tables of names and values.

use std::f64::consts::TAU;

use super::json;
use crate::run::{Frame, Record};

/// The tables, in the order of the page, as JSON.
pub(super) fn tables(record: &Record) -> String {
    let table = |title: &str, rows: Vec<String>| {
        json::object([("title", json::text(title)), ("rows", json::list(rows))])
    };
    json::list([table("Laws", laws(record)), table("End and work", work(record))])
}

/// A row: numbers are written out by the page, an arrow between them.
fn row(name: &str, values: &[f64]) -> String {
    json::list([json::text(name), json::list(values.iter().copied().map(json::number))])
}

fn laws(record: &Record) -> Vec<String> {
    let frames = &record.frames;
    let of_frames = |value: fn(&Frame) -> f64| frames.iter().map(value).collect::<Vec<_>>();
    let ends =
        |value: fn(&Frame) -> f64| [frames.first(), frames.last()].map(|end| end.map_or(f64::NAN, value));
    let turns = frames.first().map_or(f64::NAN, turning_number).round();
    let mut rows = vec![
        row("energy, first → last", &ends(|frame| frame.energy)),
        row("largest rise of the energy over a step", &[largest_rise(record)]),
        row(
            "energy − first energy + ∫ dissipation, at most",
            &[largest(of_frames(|frame| frame.energy_balance))],
        ),
    ];
    if record.counters.remaps > 0 {
        rows.push(row(
            "energy added by changes of the nodes or the gauge, at most",
            &[largest(of_frames(|frame| frame.remap_error))],
        ));
    }
    for (k, name) in record.densities.iter().enumerate() {
        let most = largest(record.mass_changes(k));
        rows.push(row(&format!("relative change of the mass of {name}, at most"), &[most]));
    }
    rows.extend([
        row("length, first → last", &ends(|frame| frame.length)),
        row("relative change of the length, at most", &[change(of_frames(|frame| frame.length))]),
        row("area, first → last", &ends(|frame| frame.area)),
        // Not relative: the signed area of a figure eight is zero up to rounding.
        row("change of the area, at most", &[drift(of_frames(|frame| frame.area))]),
        row(
            "gap at closure / length, at most",
            &[largest(of_frames(|frame| frame.closure_defect / frame.length))],
        ),
        row("turning number", &[turns]),
        row(
            "∫ κ dσ / 2π off that number, at most",
            &[largest(of_frames(turning_number).iter().map(|turning| turning - turns).collect())],
        ),
        row("self-crossings, first → last", &ends(|frame| frame.crossings)),
    ]);
    rows
}

fn work(record: &Record) -> Vec<String> {
    let counters = &record.counters;
    let rejections = &counters.rejections;
    let count = |name: &str, count: u64| row(name, &[count as f64]);
    let mut rows = vec![
        json::list([json::text("stopped because"), json::text(record.stop_reason.message())]),
        row("time reached", &[record.frames.last().map_or(f64::NAN, |frame| frame.time)]),
        count("saved frames", record.frames.len() as u64),
        count("nodes", record.nodes() as u64),
        count("steps", counters.steps),
        count("right-hand sides", counters.right_hand_sides),
        count("products of the Jacobian", counters.jacobian_products),
        count("Newton iterations", counters.newton_iterations),
        count("Krylov iterations", counters.krylov_iterations),
        count("factorisations", counters.factorisations),
        count("solves", counters.solves),
        count("rejected for the error", rejections.error),
        count("rejected for the solver", rejections.solver),
        count("rejected for a rise of the energy", rejections.energy_rise),
        count("rejected for NaN or infinity", rejections.not_finite),
    ];
    if counters.remaps > 0 {
        rows.push(count("changes of the nodes or of the gauge", counters.remaps));
    }
    if counters.unresolved_steps > 0 {
        rows.push(count("steps that the nodes do not resolve", counters.unresolved_steps));
    }
    rows.push(row("seconds of integration", &[counters.integration_seconds]));
    rows
}

/// Largest increase between neighbours in the log of steps, or in the frames if it is not there; 0 if there is none.
pub(super) fn largest_rise(record: &Record) -> f64 {
    let start = record.frames.first().map(|frame| frame.energy);
    let energies: Vec<f64> = if record.steps.energy.is_empty() {
        record.frames.iter().map(|frame| frame.energy).collect()
    } else {
        start.into_iter().chain(record.steps.energy.iter().copied()).collect()
    };
    greatest(energies.windows(2).map(|pair| pair[1] - pair[0]))
}

/// The largest magnitude.
pub(super) fn largest(values: Vec<f64>) -> f64 {
    greatest(values.into_iter().map(f64::abs))
}

/// The largest deviation from the first value.
fn drift(values: Vec<f64>) -> f64 {
    let first = values.first().copied().unwrap_or(f64::NAN);
    largest(values.into_iter().map(|value| value - first).collect())
}

/// The largest deviation from the first value, relative to it unless it is zero.
fn change(values: Vec<f64>) -> f64 {
    let first = values.first().copied().unwrap_or(f64::NAN);
    drift(values) / if first == 0.0 { 1.0 } else { first.abs() }
}

/// The greatest of `values` and zero; NaN if any of them is, unlike `f64::max`.
fn greatest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| if value.is_nan() || value > most { value } else { most })
}

/// ∫ κ dσ / 2π.
fn turning_number(frame: &Frame) -> f64 {
    let turns: f64 = frame.curvature.iter().zip(&frame.metric).map(|(kappa, g)| kappa * g).sum();
    turns / (TAU * frame.curvature.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_not_overlooked() {
        assert!(greatest([1.0, f64::NAN, 2.0]).is_nan());
        assert_eq!(greatest([-1.0, 3.0, 2.0]), 3.0);
    }

    #[test]
    fn changes_are_relative_unless_they_start_at_zero() {
        assert_eq!(change(vec![-2.0, -3.0, -2.0]), 0.5);
        assert_eq!(change(vec![0.0, 3.0]), 3.0);
    }

    #[test]
    fn a_circle_turns_once() {
        let frame = Frame { curvature: vec![0.5; 8], metric: vec![2.0 * TAU; 8], ..Frame::default() };
        assert!((turning_number(&frame) - 1.0).abs() < 1e-15);
    }
}
