//! The curve at the end of the run, coloured by its first density, with the initial curve behind it.

use super::axis::{Axis, number, range};
use super::colour_map::{FAINT, INK, viridis};
use super::drawing::{Drawing, Ink, Piece, Point, Rect};
use super::font::Text;
use super::legend;
use super::panel::{Panel, Side, draw_vertical};
use crate::run::{Frame, Record};

/// Neighbouring pieces whose colours differ by less than this share one stroke.
const COLOURS: f64 = 128.0;
const WIDTH: f64 = 8.0;

/// Draws the panel into `frame`, with the colour bar to its right.
pub(super) fn draw(drawing: &mut Drawing, frame: Rect, record: &Record, first: &Frame, last: &Frame) {
    let panel = equal_axes(frame, &[&first.position, &last.position]);
    panel.draw_axes(drawing, &Text::default().variable("x"), &Text::default().variable("y"));
    let (values, name) = coloured_by(record, last);
    let (low, high) = range(values.iter().copied());
    let bar = Axis::linear(low, high, 7);
    let initial = Ink::dashed(FAINT, 2.5, 7.0, 8.0);
    panel.line(drawing, closed(&first.position), initial);
    panel.line(drawing, closed(&last.position), Ink::line(INK, WIDTH + 2.5));
    draw_coloured(drawing, &panel, &last.position, values, &bar);
    panel.draw_frame(drawing);
    draw_bar(drawing, &panel.frame, &bar, &name);
    let time = |label: &str, time: f64| {
        Text::plain(format!("{label}, ")).variable("t").and(&format!(" = {}", number(time)))
    };
    let entries =
        [(initial, time("initial", first.time)), (Ink::line(viridis(0.45), WIDTH), time("final", last.time))];
    legend::draw(drawing, [panel.frame.left, panel.frame.top - 24.0], &entries);
}

/// The field that gives the colour: the first density, or the curvature if there is none.
fn coloured_by<'a>(record: &Record, frame: &'a Frame) -> (&'a [f64], Text) {
    match (record.densities.first(), frame.density.first()) {
        (Some(name), Some(density)) => (density, Text::plain(format!("{name} density ")).variable("ρ")),
        _ => (&frame.curvature, Text::plain("curvature ").variable("κ")),
    }
}

/// A panel that shows all curves with the same scale on both axes.
fn equal_axes(frame: Rect, curves: &[&[Point]]) -> Panel {
    let coordinate = |k: usize| range(curves.iter().flat_map(|curve| curve.iter().map(move |p| p[k])));
    let ((left, right), (bottom, top)) = (coordinate(0), coordinate(1));
    let per_pixel = 1.1 * ((right - left) / frame.width()).max((top - bottom) / frame.height());
    let around = |low: f64, high: f64, pixels: f64| {
        let (centre, half) = (0.5 * (low + high), 0.5 * pixels * per_pixel);
        Axis::linear(centre - half, centre + half, 7)
    };
    let (x, y) = (around(left, right, frame.width()), around(bottom, top, frame.height()));
    Panel { frame, x, y }
}

fn closed(points: &[Point]) -> impl Iterator<Item = Point> {
    points.iter().chain(points.first()).copied()
}

/// Draws the closed curve in pieces of one colour each.
fn draw_coloured(drawing: &mut Drawing, panel: &Panel, points: &[Point], values: &[f64], bar: &Axis) {
    let n = points.len().min(values.len());
    let shade = |i: usize| (bar.place(0.5 * (values[i % n] + values[(i + 1) % n])) * COLOURS).round();
    let mut piece: Vec<Point> = Vec::new();
    for i in 0..n {
        piece.push(points[i]);
        if i + 1 == n || shade(i) != shade(i + 1) {
            piece.push(points[(i + 1) % n]);
            let colour = viridis(shade(i) / COLOURS);
            panel.line(drawing, piece.drain(..), Ink::line(colour, WIDTH));
        }
    }
}

fn draw_bar(drawing: &mut Drawing, beside: &Rect, bar: &Axis, name: &Text) {
    let left = beside.right + 24.0;
    let rect = Rect { left, right: left + 26.0, ..*beside };
    for k in 0..COLOURS as u32 {
        let level = |k: u32| rect.bottom - rect.height() * f64::from(k) / COLOURS;
        // Reaches under its neighbour, so that no seam shows.
        let top = if k + 1 < COLOURS as u32 { level(k + 2) } else { rect.top };
        let corners = [[rect.right, level(k)], [rect.right, top], [rect.left, top]];
        let mut outline = vec![Piece::Move([rect.left, level(k)])];
        outline.extend(corners.map(Piece::Line));
        outline.push(Piece::Close);
        drawing.add(outline, Ink::Fill(viridis((f64::from(k) + 0.5) / COLOURS)));
    }
    drawing.rectangle(&rect, Ink::line(INK, 1.8));
    draw_vertical(drawing, &rect, bar, name, Side::Right, INK);
}
