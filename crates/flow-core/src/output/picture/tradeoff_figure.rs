//! The work–precision figure: errors against seconds, halfway and at the end, with the tolerance asked for at each run.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::figure::Options;
use super::file::{self, PictureError};
use super::numbers::{number, tolerance};
use super::page::{Drawn, INK, MARK, ORANGE, Page, Pattern, Pen, ROSE, SEA, SIZE, SKY, SMALL, VERMILION};
use super::panel::{Panel, Rect};
use super::render::Draw;
use crate::output::drawn::range;
use crate::run::tradeoff::{Ending, Rung, Tradeoff};

const WIDTH: f64 = 3.5;
const DOT: f64 = 6.0;
/// Room on the axis of times beside the outermost runs, for their labels.
const MARGIN: f64 = 0.16;
/// Least decades on the axes: of times, so that two of 1, 2 and 5 are labelled; of errors, so that two powers of ten are.
const LEAST_TIMES: f64 = 0.7;
const LEAST_ERRORS: f64 = 2.5;
/// The reference tells nothing about errors below this part of its tolerance.
const RESOLVED: f64 = 0.1;

/// Draws a measured ladder into the file `path`, whose name ends in `.png` or `.svg`; nodal lines are not used.
/// # Errors
/// [`PictureError`]; the target is then as it was.
pub fn plot_tradeoff(tradeoff: &Tradeoff, path: &Path, options: &Options) -> Result<(), PictureError> {
    if tradeoff.rungs().next().is_none() {
        return Err(PictureError::NoRungs);
    }
    file::write(&Figure::new(tradeoff), path, options.width, options.replace)
}

/// Errors of one name, halfway and at the end, one per run.
struct Series<'a> {
    name: &'a str,
    pen: Pen,
    errors: [Vec<f64>; 2],
}

struct Figure<'a> {
    tradeoff: &'a Tradeoff,
    rungs: Vec<(f64, &'a Rung)>,
    /// Times of the runs, in `unit`.
    times: Vec<f64>,
    unit: &'static str,
    series: Vec<Series<'a>>,
}

impl<'a> Figure<'a> {
    fn new(tradeoff: &'a Tradeoff) -> Self {
        let rungs: Vec<_> = tradeoff.rungs().collect();
        let longest = rungs.iter().map(|(_, rung)| rung.seconds).fold(0.0, f64::max);
        let (unit, per_second) = match longest {
            t if t >= 1.0 => ("s", 1.0),
            t if t >= 1e-3 => ("ms", 1e3),
            _ => ("µs", 1e6),
        };
        let mut series: Vec<Series<'a>> = Vec::new();
        for (index, (_, rung)) in rungs.iter().enumerate() {
            for (at, errors) in rung.errors.iter().enumerate() {
                for (k, (name, error)) in errors.named(&tradeoff.densities).enumerate() {
                    if index == 0 && at == 0 {
                        let pen = pen(k, tradeoff.densities.len());
                        series.push(Series { name, pen, errors: [Vec::new(), Vec::new()] });
                    }
                    series[k].errors[at].push(error);
                }
            }
        }
        let times = rungs.iter().map(|(_, rung)| per_second * rung.seconds).collect();
        Self { tradeoff, rungs, times, unit, series }
    }

    /// From the smallest to the largest error, but not below what the reference resolves.
    fn errors(&self) -> Axis {
        let all = self.series.iter().flat_map(|series| series.errors.iter().flatten().copied());
        let resolved = RESOLVED * self.tradeoff.reference.tolerance;
        logarithmic(
            all.filter(|error| *error > 0.0).map(move |error| error.max(resolved)),
            0.06,
            LEAST_ERRORS,
        )
    }

    /// Those that have a line: what the flow keeps to the last digit has none.
    fn drawn(&self) -> impl Iterator<Item = &Series<'a>> {
        self.series.iter().filter(|series| series.errors.iter().flatten().any(|error| *error > 0.0))
    }

    /// One panel: `at` is 0 halfway, 1 at the end.
    fn panel<DB: DrawingBackend>(&self, page: &Page<DB>, frame: Rect, at: usize, caption: &str) -> Drawn<DB> {
        let x = logarithmic(self.times.iter().copied().filter(|time| *time > 0.0), MARGIN, LEAST_TIMES);
        let name = format!("time of integration  [{}]", self.unit);
        let y = self.errors();
        let panel = Panel::new(page, frame, (x, &name), (y, "relative error"))?;
        for series in self.drawn() {
            let points = || self.times.iter().zip(&series.errors[at]).map(|(time, error)| [*time, *error]);
            panel.line(page, points(), series.pen)?;
            panel.dots(page, points(), series.pen.colour, DOT)?;
        }
        for (k, (asked, _)) in self.rungs.iter().enumerate() {
            let top = self.series.iter().map(|series| series.errors[at][k]).fold(y.low(), f64::max);
            let below = self.drawn().filter(|series| series.errors[at][k] < y.low());
            panel.marks_below(page, self.times[k], below.map(|series| series.pen.colour))?;
            panel.label(page, [self.times[k], top], &tolerance(*asked))?;
        }
        panel.draw_frame(page)?;
        page.text(caption, SMALL, [frame.left, frame.top - 24.0], HPos::Left)
    }
}

impl Draw for Figure<'_> {
    fn draw<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB> {
        let Tradeoff { title, span, reference, .. } = self.tradeoff;
        let top = 156.0 - page.title(title)?;
        let left = Rect { left: 112.0, top, right: 766.0, bottom: 770.0 };
        let right = Rect { left: 886.0, right: 1540.0, ..left };
        let entries: Vec<(Pen, &str)> = self.drawn().map(|series| (series.pen, series.name)).collect();
        let [x, y] = page.legend([left.left, top - 64.0], &entries)?;
        let lowest = self.errors().low();
        if self.drawn().any(|series| series.errors.iter().flatten().any(|error| *error < lowest)) {
            page.mark_below((page.px(x + 0.5 * MARK), page.px(y + 0.5 * MARK)), INK)?;
            page.text("smaller", SMALL, [x + 1.5 * MARK, y], HPos::Left)?;
        }
        let halfway = format!("half of the energy lost, t = {}", number(span.halfway));
        let end = match span.ending {
            Ending::EndTime => "end",
            Ending::Equilibrium => "at rest",
            Ending::Contact => "contact",
        };
        self.panel(page, left, 0, &halfway)?;
        self.panel(page, right, 1, &format!("{end}, t = {}", number(span.end)))?;
        let scope = match self.tradeoff.in_time_only().count() {
            0 => "time and space",
            count if count == self.rungs.len() => "time only",
            _ => "time and, of runs on fewer nodes, in space",
        };
        let note = format!(
            "numbers at the runs: tolerance asked for; errors in {scope}, against tolerance {} with {} nodes",
            tolerance(reference.tolerance),
            reference.nodes
        );
        page.text(&note, SMALL, [0.5 * SIZE[0], 872.0], HPos::Center)
    }
}

/// Dashes of the densities, and the gaps between them, for two colours in turn: seven can be told apart.
const DASHES: [[f64; 2]; 8] =
    [[14.0, 8.0], [7.0, 7.0], [4.0, 6.0], [18.0, 5.0], [30.0, 6.0], [3.0, 4.0], [9.0, 3.0], [24.0, 14.0]];

/// Curve and curvature, the densities, energy and length; what is drawn later lets the lines below show through.
fn pen(series: usize, densities: usize) -> Pen {
    let dots = |colour| Pen { colour, width: WIDTH + 1.5, pattern: Pattern::Dots { spacing: 9.0 } };
    match series {
        0 => Pen::solid(INK, WIDTH),
        1 => Pen::solid(SKY, WIDTH),
        k if k < 2 + densities => {
            let [dash, gap] = DASHES[(k - 2) % DASHES.len()];
            Pen::dashed(if k % 2 == 0 { SEA } else { ORANGE }, WIDTH, dash, gap)
        }
        k if k == 2 + densities => Pen::dashed(VERMILION, WIDTH, 24.0, 12.0),
        _ => dots(ROSE),
    }
}

/// A logarithmic axis around positive values, with `margin` of its length beside them on both sides, over `least` decades at least.
fn logarithmic(values: impl Iterator<Item = f64>, margin: f64, least: f64) -> Axis {
    let (low, high) = range(values.map(f64::log10));
    let pad = (margin * (high - low)).max(0.5 * (least - (high - low)));
    Axis::logarithmic(10_f64.powf(low - pad), 10_f64.powf(high + pad))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lines_can_be_told_apart() {
        let pens: Vec<String> = (0..11).map(|series| format!("{:?}", pen(series, 7))).collect();
        for (k, one) in pens.iter().enumerate() {
            assert!(!pens[..k].contains(one), "{one}");
        }
    }
}
