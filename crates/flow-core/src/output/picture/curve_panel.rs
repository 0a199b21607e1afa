//! The curve at the end of the run, coloured by a density, with the initial curve behind it.

use std::f64::consts::PI;

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
const LEAST_WIDTH: f64 = 3.0;
/// Part of the width of a narrow curve that its line takes; directions in which that is measured.
const OF_THE_CURVE: f64 = 0.25;
const DIRECTIONS: i32 = 256;
/// Points of the curve that are looked at.
const POINTS: usize = 1024;
const BAR_GAP: f64 = 24.0;
const BAR_WIDTH: f64 = 26.0;

/// The panel; its frame is chosen when its labels are known.
pub(super) struct CurvePanel<'a> {
    first: &'a Frame,
    last: &'a Frame,
    values: &'a [f64],
    bar: Axis,
    /// Of the density, if there is one.
    name: Option<&'a str>,
}

impl<'a> CurvePanel<'a> {
    /// Coloured by the density of this number.
    pub fn new(record: &'a Record, density: usize, first: &'a Frame, last: &'a Frame) -> Self {
        let (values, name) = coloured_by(record, density, last);
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
        let width = line_width(&last.position, x.per_pixel(frame.width()));
        panel.line(page, closed(&last.position), Pen::solid(INK, width + 3.0))?;
        draw_coloured(page, &panel, last, self.values, (self.bar, width))?;
        panel.draw_frame(page)?;
        let name = self.name.map(|name| page.density(name, frame.height())).transpose()?;
        draw_bar(page, frame, self.bar, name.as_deref().unwrap_or("curvature κ"))?;
        let [from, to] = [("initial", first), ("final", last)]
            .map(|(when, frame)| format!("{when}, t = {}", number(frame.time)));
        let entries = [(initial, from.as_str()), (Pen::solid(shade(0.45), WIDTH), &to)];
        page.legend([frame.left, frame.top - 24.0], &entries).map(drop)
    }

    fn axes(&self, frame: Rect) -> (Axis, Axis) {
        equal_axes(frame, &[&self.first.position, &self.last.position])
    }
}

/// The field that gives the colour: the density, or the curvature if there is none.
fn coloured_by<'a>(record: &'a Record, density: usize, frame: &'a Frame) -> (&'a [f64], Option<&'a str>) {
    match (record.densities.get(density), frame.density.get(density)) {
        (Some(name), Some(density)) => (density, Some(name)),
        _ => (&frame.curvature, None),
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

/// Width of the line of a curve: less where it would fill the inside of a narrow one. What is small in all directions is a dot.
fn line_width(points: &[[f64; 2]], per_pixel: f64) -> f64 {
    let each = points.len().div_ceil(POINTS).max(1);
    let widths = (0..DIRECTIONS).map(|k| {
        let (sin, cos) = (PI * f64::from(k) / f64::from(DIRECTIONS)).sin_cos();
        let (low, high) = range_of_positions(points.iter().step_by(each).map(|[x, y]| x * cos + y * sin));
        (high - low) / per_pixel
    });
    let (narrow, wide) = widths
        .fold((f64::INFINITY, 0.0), |(narrow, wide): (f64, f64), width| (narrow.min(width), wide.max(width)));
    if wide > WIDTH / OF_THE_CURVE { (OF_THE_CURVE * narrow).clamp(LEAST_WIDTH, WIDTH) } else { WIDTH }
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
    frame: &Frame,
    values: &[f64],
    (bar, width): (Axis, f64),
) -> Drawn<DB> {
    let points = &frame.position;
    let n = points.len().min(values.len());
    (0..n).try_for_each(|i| {
        let next = (i + 1) % n;
        let colour = shade(bar.place(0.5 * (values[i] + values[next])));
        panel.line(page, [points[i], points[next]], Pen::solid(colour, width))
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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Of an ellipse of these half axes in pixels, whose axes are not those of the page.
    fn width(long: f64, short: f64) -> f64 {
        let point = |k: i32| {
            let (sin, cos) = (TAU * f64::from(k) / 256.0).sin_cos();
            [0.6 * long * cos - 0.8 * short * sin, 0.8 * long * cos + 0.6 * short * sin]
        };
        line_width(&(0..256).map(point).collect::<Vec<_>>(), 1.0)
    }

    #[test]
    fn a_line_leaves_the_inside_of_its_curve_free() {
        assert_eq!(width(300.0, 200.0), WIDTH);
        let narrow = width(300.0, 6.0);
        assert!((LEAST_WIDTH..0.6 * WIDTH).contains(&narrow), "{narrow}");
        assert_eq!(width(300.0, 0.0), LEAST_WIDTH);
        assert_eq!(width(1.0, 1.0), WIDTH, "a dot");
    }
}
