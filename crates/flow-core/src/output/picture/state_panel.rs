//! The final state in the plane of density and curvature, with the nodal lines of the energy; without a
//! density, curvature against arc length.

use plotters::prelude::DrawingBackend;

use super::axis::Axis;
use super::page::{Drawn, FAINT, INK, Page, Pattern, Pen, SEA, SKY, VERMILION};
use super::panel::{Panel, Rect};
use crate::run::{Frame, Record};

const INITIAL: Pen = Pen::dashed(FAINT, 2.5, 8.0, 6.0);
const FINAL: Pen = Pen::solid(INK, 4.0);
/// A state that covers less than this part of both axes is drawn as a dot.
const POINT: f64 = 0.01;
const DOT: f64 = 7.0;

/// Lines of the (ρ, κ) plane on which the energy of the agents vanishes, as samples (ρ, κ).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalLines {
    /// Preferred curvature κ₀(ρ).
    pub preferred_curvature: Vec<(f64, f64)>,
    /// Low density ρ₋(κ).
    pub low: Vec<(f64, f64)>,
    /// High density ρ₊(κ).
    pub high: Vec<(f64, f64)>,
}

/// The panel; its frame is chosen when its labels are known.
pub(super) struct StatePanel<'a> {
    x: Axis,

    y: Axis,
    last: Vec<[f64; 2]>,
    shows: Shows<'a>,
}

enum Shows<'a> {
    /// Density, of this name, and curvature, with these lines.
    Plane(Option<&'a str>, Option<&'a NodalLines>),
    /// Curvature over arc length, with that of the initial state.
    Curvature { first: Vec<[f64; 2]> },
}

impl<'a> StatePanel<'a> {
    /// With the density of this number.
    pub fn new(
        record: &'a Record,
        density: usize,
        [first, last]: [&Frame; 2],
        lines: Option<&'a NodalLines>,
    ) -> Self {
        // A name that tells nothing apart is left to the bar of colours.
        let name = record.densities.get(density).filter(|_| record.densities.len() > 1);
        if let Some(density) = last.density.get(density) {
            let last = pairs(density, &last.curvature);
            // Room for the nodal lines around the state, which ends on them.
            let [x, y] = [0, 1].map(|k| Axis::around(last.iter().map(move |point| point[k]), 0.15));
            Self { x, y, last, shows: Shows::Plane(name.map(String::as_str), lines) }
        } else {
            let y = Axis::around(first.curvature.iter().chain(&last.curvature).copied(), 0.1);
            let [first, last] = [first, last].map(over_arc_length);
            Self { x: Axis::linear(0.0, 1.0), y, last, shows: Shows::Curvature { first } }
        }
    }

    /// Room for the labels on the left.
    pub fn room<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB, f64> {
        Panel::room(page, self.y)
    }

    /// Draws the panel into `frame`.
    pub fn draw<DB: DrawingBackend>(&self, page: &Page<DB>, frame: Rect) -> Drawn<DB> {
        let x_name = match self.shows {
            Shows::Plane(Some(name), _) => page.density(name, frame.width())?,
            Shows::Plane(None, _) => "density ρ".to_owned(),
            Shows::Curvature { .. } => "arc length σ / |Γ|".to_owned(),
        };
        let panel = Panel::new(page, frame, (self.x, &x_name), (self.y, "curvature κ"))?;
        let mut entries = Vec::new();
        match &self.shows {
            Shows::Plane(_, lines) => {
                entries.push((FINAL, "final"));
                for (points, pen, label) in lines.map(styled).into_iter().flatten() {
                    if !points.is_empty() {
                        panel.line(page, points.iter().map(|&(x, y)| [x, y]), pen)?;
                        entries.push((pen, label));
                    }
                }
            }
            Shows::Curvature { first } => {
                entries.extend([(INITIAL, "initial"), (FINAL, "final")]);
                panel.line(page, first.iter().copied(), INITIAL)?;
            }
        }
        panel.line(page, self.last.iter().copied(), FINAL)?;
        if self.is_a_point() {
            panel.dots(page, self.last.first().copied(), INK, DOT)?;
        }
        panel.draw_frame(page)?;
        page.legend([frame.left, frame.top - 24.0], &entries).map(drop)
    }

    fn is_a_point(&self) -> bool {
        [(self.x, 0), (self.y, 1)].into_iter().all(|(axis, k)| {
            let places = self.last.iter().map(|point| axis.place(point[k]));
            let (low, high) = places
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            high - low < POINT
        })
    }
}

/// Points (ρ, κ) with their look and name.
type Styled<'a> = (&'a [(f64, f64)], Pen, &'static str);

fn styled(lines: &NodalLines) -> [Styled<'_>; 3] {
    let dots = Pen { colour: SEA, width: 5.0, pattern: Pattern::Dots { spacing: 9.0 } };
    [
        (&lines.preferred_curvature, Pen::solid(VERMILION, 3.0), "κ₀(ρ)"),
        (&lines.low, Pen::dashed(SKY, 3.0, 11.0, 7.0), "ρ₋(κ)"),
        (&lines.high, dots, "ρ₊(κ)"),
    ]
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
