//! Energy (left axis) and length (right axis) over time, in decades of time where the run spans several.

use super::axis::Axis;
use super::colour_map::{BLUE, VERMILION};
use super::drawing::{Drawing, Ink, Point, Rect};
use super::font::Text;
use super::legend;
use super::panel::{Panel, Side, draw_vertical};
use crate::run::Record;

/// Decades of time shown at most.
const MOST_DECADES: i32 = 10;

/// Draws the panel into `frame`.
pub(super) fn draw(drawing: &mut Drawing, frame: Rect, record: &Record) {
    let energy = energy(record);
    let length: Vec<Point> = record.frames.iter().map(|frame| [frame.time, frame.length]).collect();
    let x = time_axis(energy.iter().chain(&length).map(|point| point[0]));
    let y = Axis::around(energy.iter().map(|point| point[1]), 0.08, 5);
    let right = Axis::around(length.iter().map(|point| point[1]), 0.08, 5);
    let (solid, dashed) = (Ink::line(BLUE, 3.5), Ink::dashed(VERMILION, 3.5, 12.0, 9.0));
    let panel = Panel { frame, x: x.clone(), y };
    panel.draw_axes(drawing, &Text::plain("time ").variable("t"), &Text::plain("energy"));
    draw_vertical(drawing, &frame, &right, &Text::plain("length"), Side::Right, VERMILION);
    panel.line(drawing, energy, solid);
    Panel { frame, x, y: right }.line(drawing, length, dashed);
    panel.draw_frame(drawing);
    let entries = [(solid, Text::plain("energy")), (dashed, Text::plain("length"))];
    legend::draw(drawing, [frame.left, frame.top - 24.0], &entries);
}

/// Energy over time: of every step if the steps were logged, otherwise of the frames.
fn energy(record: &Record) -> Vec<Point> {
    let steps = &record.steps;
    if steps.time.len() < record.frames.len() {
        return record.frames.iter().map(|frame| [frame.time, frame.energy]).collect();
    }
    let start = record.frames.first().map(|frame| [frame.time, frame.energy]);
    start
        .into_iter()
        .chain(steps.time.iter().zip(&steps.energy).map(|(&time, &energy)| [time, energy]))
        .collect()
}

fn time_axis(times: impl Iterator<Item = f64> + Clone) -> Axis {
    let end = times.clone().filter(|time| time.is_finite()).fold(0.0, f64::max);
    let start = times.filter(|time| *time > 0.0).fold(end, f64::min).max(end * 10_f64.powi(-MOST_DECADES));
    if end > 10.0 * start {
        Axis::decades(start, end, 6)
    } else {
        Axis::linear(0.0, if end > 0.0 { end } else { 1.0 }, 6)
    }
}
