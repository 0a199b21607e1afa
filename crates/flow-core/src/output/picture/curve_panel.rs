//! The curve at the end of the run, coloured by its first density, with the initial curve behind it.

use plotters::prelude::*;

use super::axis::Axis;
use super::numbers::number;
use super::page::{Drawn, FAINT, INK, Page, Pen};
use super::panel::{Panel, Rect};
use crate::output::drawn::{range, range_of_positions};
use crate::run::{Frame, Record};

/// Colours of the bar.
const COLOURS: i32 = 128;
const WIDTH: f64 = 8.0;
const BAR_GAP: f64 = 24.0;
const BAR_WIDTH: f64 = 26.0;

/// The panel; its frame is chosen when its labels are known.
pub(super) struct CurvePanel<'a> {
    first: &'a Frame,
    last: &'a Frame,
    values: &'a [f64],
    bar: Axis,
    name: String,
}

impl<'a> CurvePanel<'a> {
    pub fn new(record: &Record, first: &'a Frame, last: &'a Frame) -> Self {
        let (values, name) = coloured_by(record, last);
        let (low, high) = range(values.iter().copied());
        Self { first, last, values, bar: Axis::linear(low, high), name }
    }

    /// `frame` with so much room on its left, from `edge` on, as its labels need.
    pub fn fitted<DB: DrawingBackend>(&self, page: &Page<DB>, frame: Rect, edge: f64) -> Drawn<DB, Rect> {
        let room = Panel::room(page, self.axes(frame).1)?;
        Ok(Rect { left: frame.left.max(edge + room), ..frame })
    }

    /// Room on the right for the bar and its labels.
    pub fn room<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB, f64> {
        Ok(BAR_GAP + BAR_WIDTH + Panel::room(page, self.bar)?)
    }

    /// Draws the panel into `frame`, with the colour bar to its right.
    pub fn draw<DB: DrawingBackend>(&self, page: &Page<DB>, frame: Rect) -> Drawn<DB> {
        let Self { first, last, .. } = self;
        let (x, y) = self.axes(frame);
        let panel = Panel::new(page, frame, (x, "x"), (y, "y"))?;
        let initial = Pen::dashed(FAINT, 2.5, 8.0, 6.0);
        panel.line(page, closed(&first.position), initial)?;
        panel.line(page, closed(&last.position), Pen::solid(INK, WIDTH + 3.0))?;
        draw_coloured(page, &panel, &last.position, self.values, self.bar)?;
        panel.draw_frame(page)?;
        draw_bar(page, frame, self.bar, &self.name)?;
        let [from, to] = [("initial", first), ("final", last)]
            .map(|(when, frame)| format!("{when}, t = {}", number(frame.time)));
        let entries = [(initial, from.as_str()), (Pen::solid(shade(0.45), WIDTH), &to)];
        page.legend([frame.left, frame.top - 24.0], &entries).map(drop)
    }

    fn axes(&self, frame: Rect) -> (Axis, Axis) {
        equal_axes(frame, &[&self.first.position, &self.last.position])
    }
}

/// The field that gives the colour: the first density, or the curvature if there is none.
fn coloured_by<'a>(record: &Record, frame: &'a Frame) -> (&'a [f64], String) {
    match (record.densities.first(), frame.density.first()) {
        (Some(name), Some(density)) => (density, format!("{name} density ρ")),
        _ => (&frame.curvature, "curvature κ".to_owned()),
    }
}

/// Axes that show all curves with the same scale.
fn equal_axes(frame: Rect, curves: &[&[[f64; 2]]]) -> (Axis, Axis) {
    let coordinate =
        |k: usize| range_of_positions(curves.iter().flat_map(|curve| curve.iter().map(move |p| p[k])));
    let ((left, right), (bottom, top)) = (coordinate(0), coordinate(1));
    let per_pixel = 1.1 * ((right - left) / frame.width()).max((top - bottom) / frame.height());
    let around = |low: f64, high: f64, pixels: f64| {
        let (centre, half) = (0.5 * (low + high), 0.5 * pixels * per_pixel);
        Axis::linear(centre - half, centre + half)
    };
    (around(left, right, frame.width()), around(bottom, top, frame.height()))
}

fn closed(points: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    points.iter().chain(points.first()).copied()
}

fn shade(place: f64) -> RGBColor {
    ViridisRGB.get_color(place)
}

/// Draws the closed curve, each side between two nodes in one colour.
fn draw_coloured<DB: DrawingBackend>(
    page: &Page<DB>,
    panel: &Panel,
    points: &[[f64; 2]],
    values: &[f64],
    bar: Axis,
) -> Drawn<DB> {
    let n = points.len().min(values.len());
    (0..n).try_for_each(|i| {
        let next = (i + 1) % n;
        let colour = shade(bar.place(0.5 * (values[i] + values[next])));
        panel.line(page, [points[i], points[next]], Pen::solid(colour, WIDTH))
    })
}

fn draw_bar<DB: DrawingBackend>(page: &Page<DB>, beside: Rect, bar: Axis, name: &str) -> Drawn<DB> {
    let left = beside.right + BAR_GAP;
    let frame = Rect { left, right: left + BAR_WIDTH, ..beside };
    let panel = Panel::right(page, frame, Axis::linear(0.0, 1.0), (bar, name), INK)?;
    for k in 0..COLOURS {
        let place = |k: i32| f64::from(k.min(COLOURS)) / f64::from(COLOURS);
        // Reaches under its neighbour, so that no seam shows.
        let corners = [panel.pixel([0.0, place(k + 2)]), panel.pixel([1.0, place(k)])];
        page.root.draw(&Rectangle::new(corners, shade(place(k)).filled()))?;
    }
    panel.draw_frame(page)
}
