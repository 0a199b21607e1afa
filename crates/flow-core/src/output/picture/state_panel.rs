//! The final state in the plane of density and curvature, with the nodal lines of the energy; without a
//! density, curvature against arc length.

use plotters::prelude::DrawingBackend;

use super::axis::Axis;
use super::figure::NodalLines;
use super::page::{Drawn, FAINT, INK, Page, Pattern, Pen, SEA, SKY, VERMILION};
use super::panel::{Panel, Rect};
use crate::run::Frame;

const INITIAL: Pen = Pen::dashed(FAINT, 2.5, 8.0, 6.0);
const FINAL: Pen = Pen::solid(INK, 4.0);

/// Draws the panel into `frame`.
pub(super) fn draw<DB: DrawingBackend>(
    page: &Page<DB>,
    frame: Rect,
    first: &Frame,
    last: &Frame,
    lines: Option<&NodalLines>,
) -> Drawn<DB> {
    match last.density.first() {
        Some(density) => draw_plane(page, frame, &pairs(density, &last.curvature), lines),
        None => draw_curvature(page, frame, first, last),
    }
}

fn draw_plane<DB: DrawingBackend>(
    page: &Page<DB>,
    frame: Rect,
    to: &[[f64; 2]],
    lines: Option<&NodalLines>,
) -> Drawn<DB> {
    // Room for the nodal lines around the state, which ends on them.
    let [x, y] = [0, 1].map(|k| Axis::around(to.iter().map(move |point| point[k]), 0.15));
    let panel = Panel::new(page, frame, (x, "density ρ"), (y, "curvature κ"))?;
    let mut entries = vec![(FINAL, "final")];
    if let Some(lines) = lines {
        let dots = Pen { colour: SEA, width: 5.0, pattern: Pattern::Dots { spacing: 9.0 } };
        for (points, pen, label) in [
            (&lines.preferred_curvature, Pen::solid(VERMILION, 3.0), "κ₀(ρ)"),
            (&lines.low, Pen::dashed(SKY, 3.0, 11.0, 7.0), "ρ₋(κ)"),
            (&lines.high, dots, "ρ₊(κ)"),
        ] {
            if !points.is_empty() {
                panel.line(page, points.iter().map(|&(x, y)| [x, y]), pen)?;
                entries.push((pen, label));
            }
        }
    }
    panel.line(page, to.iter().copied(), FINAL)?;
    panel.draw_frame(page)?;
    page.legend([frame.left, frame.top - 24.0], &entries)
}

fn draw_curvature<DB: DrawingBackend>(
    page: &Page<DB>,
    frame: Rect,
    first: &Frame,
    last: &Frame,
) -> Drawn<DB> {
    let y = Axis::around(first.curvature.iter().chain(&last.curvature).copied(), 0.1);
    let name = "arc length σ / |Γ|";
    let panel = Panel::new(page, frame, (Axis::linear(0.0, 1.0), name), (y, "curvature κ"))?;
    panel.line(page, over_arc_length(first), INITIAL)?;
    panel.line(page, over_arc_length(last), FINAL)?;
    panel.draw_frame(page)?;
    page.legend([frame.left, frame.top - 24.0], &[(INITIAL, "initial"), (FINAL, "final")])
}

/// The closed trace of density and curvature.
fn pairs(density: &[f64], curvature: &[f64]) -> Vec<[f64; 2]> {
    let points: Vec<_> = density.iter().zip(curvature).map(|(&rho, &kappa)| [rho, kappa]).collect();
    points.iter().chain(points.first()).copied().collect()
}

/// Curvature against arc length from the first node, once around, in units of the length.
fn over_arc_length(frame: &Frame) -> Vec<[f64; 2]> {
    let n = frame.metric.len().min(frame.curvature.len());
    let length: f64 = frame.metric[..n].iter().sum();
    let mut sigma = 0.0;
    let point = |i: usize| {
        let here = [sigma / length, frame.curvature[i % n]];
        sigma += 0.5 * (frame.metric[i % n] + frame.metric[(i + 1) % n]);
        here
    };
    if n == 0 { Vec::new() } else { (0..=n).map(point).collect() }
}
