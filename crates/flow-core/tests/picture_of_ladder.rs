//! Figures of ladders of tolerances: odd ones neither panic nor draw outside the page.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(feature = "picture")]

mod drawn;
mod folder;

use std::fs;

use flow_core::output::picture::{Options, PictureError, plot_tradeoff};
use flow_core::run::tradeoff::{Ending, Errors, Reference, Row, RunError, Rung, Span, Tradeoff};

use drawn::assert_inside;
use folder::Folder;

/// A ladder of decades whose errors are near the tolerance, with runs of `seconds` and more.
fn ladder(densities: &[&str], seconds: f64) -> Tradeoff {
    let rung = |k: i32| {
        let tolerance = 10_f64.powi(-k);
        let errors = |part: f64| Errors {
            curve: 0.1 * part * tolerance,
            curvature: part * tolerance,
            densities: densities.iter().map(|_| 0.5 * part * tolerance).collect(),
            energy: 0.02 * part * tolerance,
            length: 0.0,
        };
        let steps = 20 * k as u64;
        let rung =
            Rung { nodes: 512, steps, seconds: seconds * f64::from(k), errors: [errors(1.0), errors(0.01)] };
        Row { tolerance, outcome: Ok(rung) }
    };
    Tradeoff {
        title: "Three-fold protein membrane".to_owned(),
        densities: densities.iter().map(|&name| name.to_owned()).collect(),
        span: Span { halfway: 2e-5, end: 9.15, ending: Ending::Equilibrium },
        reference: Reference { tolerance: 1e-10, at_rounding: false, nodes: 1024, steps: 500, seconds: 9.0 },
        rows: (2..9).map(rung).collect(),
    }
}

/// Draws `ladder` as SVG; returns it.
fn draw_ladder(ladder: &Tradeoff, name: &str) -> String {
    let folder = Folder::new(name);
    let path = folder.file("ladder.svg");
    plot_tradeoff(ladder, &path, &Options { replace: true, ..Options::default() }).unwrap();
    fs::read_to_string(&path).unwrap()
}

#[test]
fn ladders_are_drawn_with_their_tolerances() {
    let svg = draw_ladder(&ladder(&["protein"], 0.01), "ladder");
    assert_inside(&svg);
    let texts = ["protein", "curvature", "10⁻²", "10⁻⁸", "[ms]", "at rest, t = 9.15", "time and space"];
    for text in texts {
        assert!(svg.contains(text), "{text}");
    }
    for (seconds, unit) in [(1e-6, "[µs]"), (1.0, "[s]")] {
        assert!(draw_ladder(&ladder(&[], seconds), "unit").contains(unit));
    }
}

/// Below a tenth of the tolerance of the reference there is no axis.
#[test]
fn errors_below_the_axis_are_marked() {
    let marks = |svg: &str| svg.matches("<polygon").count();
    let mut plain = ladder(&[], 0.01);
    plain.reference.tolerance = 1e-12;
    assert_eq!(marks(&draw_ladder(&plain, "above")), 0);
    let mut fine = ladder(&[], 0.01);
    for row in &mut fine.rows {
        let rung = row.outcome.as_mut().unwrap();
        rung.errors.iter_mut().for_each(|errors| errors.energy = 1e-14);
    }
    let svg = draw_ladder(&fine, "below");
    assert_eq!(marks(&svg), 2 * fine.rows.len() + 1);
    assert!(svg.contains("smaller"));
    // Where all are, the panels are not empty.
    for row in &mut fine.rows {
        let least =
            Errors { curve: 1e-15, curvature: 1e-15, densities: Vec::new(), energy: 1e-15, length: 1e-15 };
        row.outcome.as_mut().unwrap().errors = [least.clone(), least];
    }
    let svg = draw_ladder(&fine, "all-below");
    assert_inside(&svg);
    assert!(marks(&svg) > 2 * fine.rows.len() && svg.contains("10⁻²"));
}

#[test]
fn odd_ladders_are_drawn() {
    let mut odd = ladder(&["a", "b", "c"], 0.0);
    odd.rows[1].outcome = Err(RunError::Interrupted);
    if let Ok(rung) = &mut odd.rows[0].outcome {
        rung.errors[0].curvature = f64::NAN;
        rung.errors[1].energy = f64::INFINITY;
    }
    assert_inside(&draw_ladder(&odd, "odd-ladder"));
    odd.rows.truncate(1);
    assert_inside(&draw_ladder(&odd, "one-rung"));
    odd.rows.clear();
    let folder = Folder::new("no-rungs");
    let path = folder.file("ladder.svg");
    assert!(matches!(plot_tradeoff(&odd, &path, &Options::default()), Err(PictureError::NoRungs)));
}
