//! Energy (left axis) and length (right axis) over time, in decades of time where the run spans several.

use plotters::prelude::DrawingBackend;

use super::axis::Axis;
use super::page::{Drawn, Page, Pen, SKY, VERMILION};
use super::panel::{Panel, Rect};
use crate::run::Record;

const ENERGY: Pen = Pen::solid(SKY, 4.0);
const LENGTH: Pen = Pen::dashed(VERMILION, 4.0, 12.0, 8.0);

/// Draws the panel into `frame`.
pub(super) fn draw<DB: DrawingBackend>(page: &Page<DB>, frame: Rect, record: &Record) -> Drawn<DB> {
    let energy = energy(record);
    let mut length: Vec<_> = record.frames.iter().map(|frame| [frame.time, frame.length]).collect();
    let x = time_axis(energy.iter().chain(&length).map(|point| point[0]));
    if let (Some(initial), Some(step)) = (length.first_mut(), energy.get(1)) {
        // Frames are rarer than steps: up to the first one the length is that of the start.
        initial[0] = initial[0].max(step[0]);
    }
    // Time zero has no place on a logarithmic axis.
    let shown = |point: &&[f64; 2]| x.place(point[0]).is_finite();
    let y = Axis::fitted(energy.iter().filter(shown).map(|point| point[1]), 0.08);
    let right = Axis::around(length.iter().filter(shown).map(|point| point[1]), 0.08);
    let panel = Panel::new(page, frame, (x, "time t"), (y, "energy"))?;
    let on_the_right = Panel::right(page, frame, x, (right, "length"), VERMILION)?;
    panel.line(page, energy, ENERGY)?;
    on_the_right.line(page, length, LENGTH)?;
    panel.draw_frame(page)?;
    page.legend([frame.left, frame.top - 24.0], &[(ENERGY, "energy"), (LENGTH, "length")])
}

/// Energy over time: of every step if the steps were logged, otherwise of the frames.
fn energy(record: &Record) -> Vec<[f64; 2]> {
    let steps = &record.steps;
    if steps.time.len() < record.frames.len() {
        return record.frames.iter().map(|frame| [frame.time, frame.energy]).collect();
    }
    let start = record.frames.first().map(|frame| [frame.time, frame.energy]);
    let logged = steps.time.iter().zip(&steps.energy).map(|(&time, &energy)| [time, energy]);
    start.into_iter().chain(logged).collect()
}

fn time_axis(times: impl Iterator<Item = f64> + Clone) -> Axis {
    let end = times.clone().filter(|time| time.is_finite()).fold(0.0, f64::max);
    let start = times.filter(|time| *time > 0.0).fold(end, f64::min);
    if end > 10.0 * start {
        Axis::logarithmic(start, end * (1.0 + 1e-9))
    } else {
        Axis::linear(0.0, if end > 0.0 { end } else { 1.0 })
    }
}
