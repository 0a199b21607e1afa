//! The final state in the plane of density and curvature, with the nodal lines of the energy; without a
//! density, curvature against arc length.

use super::axis::{Axis, range};
use super::colour_map::{BLUE, FAINT, GREEN, INK, PURPLE, VERMILION};
use super::drawing::{Drawing, Ink, Point, Rect};
use super::figure::NodalLines;
use super::font::Text;
use super::legend;
use super::panel::Panel;
use crate::run::Frame;

/// Draws the panel into `frame`.
pub(super) fn draw(
    drawing: &mut Drawing,
    frame: Rect,
    first: &Frame,
    last: &Frame,
    lines: Option<&NodalLines>,
) {
    match (first.density.first(), last.density.first()) {
        (Some(from), Some(to)) => {
            let (from, to) = (pairs(from, &first.curvature), pairs(to, &last.curvature));
            draw_plane(drawing, frame, &from, &to, lines);
        }
        _ => draw_curvature(drawing, frame, first, last),
    }
}

fn draw_plane(drawing: &mut Drawing, frame: Rect, from: &[Point], to: &[Point], lines: Option<&NodalLines>) {
    let all = |k: usize| from.iter().chain(to).map(move |point| point[k]);
    // Room for the nodal lines around the state, which ends on them.
    let (x, y) = (Axis::around(all(0), 0.15, 6), Axis::around(all(1), 0.15, 5));
    let panel = Panel { frame, x, y };
    let variable = |text: &str, name: &str| Text::plain(text).variable(name);
    panel.draw_axes(drawing, &variable("density ", "ρ"), &variable("curvature ", "κ"));
    let mut entries = vec![(Ink::line(INK, 4.0), Text::plain("final"))];
    if let Some(lines) = lines {
        let of = |name: &str, subscript: &str, argument: &str| {
            Text::default().variable(name).and(&format!("{subscript}(")).variable(argument).and(")")
        };
        for (points, ink, label) in [
            (&lines.preferred_curvature, Ink::line(VERMILION, 2.8), of("κ", "₀", "ρ")),
            (&lines.low, Ink::dashed(BLUE, 2.8, 11.0, 8.0), of("ρ", "₋", "κ")),
            (&lines.high, Ink::dashed(GREEN, 3.6, 0.5, 7.5), of("ρ", "₊", "κ")),
        ] {
            if !points.is_empty() {
                panel.line(drawing, points.iter().map(|&(x, y)| [x, y]), ink);
                entries.push((ink, label));
            }
        }
    }
    panel.line(drawing, from.iter().copied(), Ink::dashed(FAINT, 2.5, 7.0, 8.0));
    panel.line(drawing, to.iter().copied(), Ink::line(INK, 4.0));
    panel.draw_frame(drawing);
    legend::draw(drawing, [panel.frame.left, panel.frame.top - 24.0], &entries);
}

fn draw_curvature(drawing: &mut Drawing, frame: Rect, first: &Frame, last: &Frame) {
    let curvatures = first.curvature.iter().chain(&last.curvature).copied();
    let y = Axis::around(curvatures, 0.1, 5);
    let (initial, end) = (over_arc_length(first), over_arc_length(last));
    let (_, longest) = range(initial.iter().chain(&end).map(|point| point[0]));
    let panel = Panel { frame, x: Axis::linear(0.0, longest, 6), y };
    panel.draw_axes(
        drawing,
        &Text::plain("arc length ").variable("σ"),
        &Text::plain("curvature ").variable("κ"),
    );
    let (dashed, solid) = (Ink::dashed(FAINT, 2.5, 7.0, 8.0), Ink::line(PURPLE, 3.5));
    panel.line(drawing, initial, dashed);
    panel.line(drawing, end, solid);
    panel.draw_frame(drawing);
    let entries = [(dashed, Text::plain("initial")), (solid, Text::plain("final"))];
    legend::draw(drawing, [panel.frame.left, panel.frame.top - 24.0], &entries);
}

/// The closed trace of density and curvature.
fn pairs(density: &[f64], curvature: &[f64]) -> Vec<Point> {
    let points: Vec<Point> = density.iter().zip(curvature).map(|(&rho, &kappa)| [rho, kappa]).collect();
    points.iter().chain(points.first()).copied().collect()
}

/// Curvature against arc length from the first node, once around.
fn over_arc_length(frame: &Frame) -> Vec<Point> {
    let n = frame.metric.len();
    let mut sigma = 0.0;
    let point = |i: usize| {
        let here = [sigma, frame.curvature[i % n]];
        sigma += 0.5 * (frame.metric[i % n] + frame.metric[(i + 1) % n]) / n as f64;
        here
    };
    if n == 0 { Vec::new() } else { (0..=n).map(point).collect() }
}
