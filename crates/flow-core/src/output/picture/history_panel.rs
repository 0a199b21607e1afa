//! Energy (left axis) and length (right axis) over time, in decades of time where the run spans several.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::page::{Drawn, INK, Page, Pen, SKY, SMALL, VERMILION};
use super::panel::{Panel, Rect};
use crate::output::drawn::energy_over_time;
use crate::run::Record;

const ENERGY: Pen = Pen::solid(SKY, 4.0);
const LENGTH: Pen = Pen::dashed(VERMILION, 4.0, 12.0, 8.0);
const DOT: f64 = 6.0;
const RING: f64 = 7.0;
/// Parts of the axes: a line that is longer in time is a guess, unless it rises or falls by less than what is visible.
const SPARSE: f64 = 0.05;
const VISIBLE: f64 = 0.02;

/// Values over time, with their axis.
struct Series {
    points: Vec<[f64; 2]>,
    axis: Axis,
    pen: Pen,
}

/// The panel; its frame is chosen when its labels are known.
pub(super) struct HistoryPanel {
    time: Axis,
    energy: Series,
    length: Series,
}

impl HistoryPanel {
    pub fn new(record: &Record) -> Self {
        let energy = energy_over_time(&record.frames, &record.steps, 1);
        let length: Vec<_> = record.frames.iter().map(|frame| [frame.time, frame.length]).collect();
        let time = time_axis(energy.iter().map(|point| point[0]));
        let values = |points: &[[f64; 2]]| points.iter().map(|point| point[1]).collect::<Vec<_>>();
        let axis = Axis::fitted(values(&energy), 0.08);
        let energy = Series { points: energy, axis, pen: ENERGY };
        let axis = Axis::around(values(&length), 0.08);
        Self { time, energy, length: Series { points: length, axis, pen: LENGTH } }
    }

    /// Room for the labels on the left and on the right.
    pub fn rooms<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB, [f64; 2]> {
        Ok([Panel::room(page, self.energy.axis)?, Panel::room(page, self.length.axis)?])
    }

    /// Draws the panel into `frame`.
    pub fn draw<DB: DrawingBackend>(&self, page: &Page<DB>, frame: Rect) -> Drawn<DB> {
        let (energy, length) = (&self.energy, &self.length);
        let left = Panel::new(page, frame, (self.time, "time t"), (energy.axis, "energy"))?;
        let right = Panel::right(page, frame, self.time, (length.axis, "length"), VERMILION)?;
        for (panel, series) in [(&left, energy), (&right, length)] {
            panel.line(page, series.points.iter().copied(), series.pen)?;
            panel.dots(page, series.sparse(self.time), series.pen.colour, DOT)?;
        }
        left.draw_frame(page)?;
        let starts = [(&left, energy), (&right, length)]
            .map(|(panel, series)| (panel, series, series.start(self.time)));
        for (panel, series, start) in &starts {
            if let Some(value) = start {
                page.ring(panel.pixel([0.0, series.axis.place(*value)]), RING, series.pen.colour)?;
            }
        }
        let mut next = [frame.left, frame.top - 24.0];
        for (series, name) in [(energy, "energy"), (length, "length")] {
            let dot = [page.px(next[0] + 0.5 * series.pen.sample()), page.px(next[1])];
            next = page.legend(next, &[(series.pen, name)])?;
            if !series.sparse(self.time).is_empty() {
                page.root.draw(&Circle::new((dot[0], dot[1]), page.px(DOT), series.pen.colour.filled()))?;
            }
        }
        let [x, y] = next;
        if starts.iter().any(|(_, _, start)| start.is_some()) {
            page.ring((page.px(x + RING), page.px(y)), RING, INK)?;
            page.text("t = 0", SMALL, [x + 2.0 * RING + 9.0, y], HPos::Left)?;
        }
        Ok(())
    }
}

impl Series {
    /// The ends of lines that are a guess, long in time and not flat, and the point after a start that has no place on the
    /// axis: no line leads to it.
    fn sparse(&self, time: Axis) -> Vec<[f64; 2]> {
        let points = &self.points;
        let at = |i: usize| [time.place(points[i][0]), self.axis.place(points[i][1])];
        let guessed = |i: usize| {
            let ([from, low], [to, high]) = (at(i), at(i + 1));
            to - from.max(0.0) > SPARSE && (!from.is_finite() || (high - low).abs() > VISIBLE)
        };
        let marked = |i: usize| (i > 0 && guessed(i - 1)) || (i + 1 < points.len() && guessed(i));
        (0..points.len()).filter(|&i| at(i)[0].is_finite() && marked(i)).map(|i| points[i]).collect()
    }

    /// The value at time zero if it has no place on the axis of `time`, and what follows does not show it.
    fn start(&self, time: Axis) -> Option<f64> {
        let (first, next) = (self.points.first()?, self.points.get(1)?);
        let shown = time.place(next[0]) < SPARSE
            && (self.axis.place(first[1]) - self.axis.place(next[1])).abs() < VISIBLE;
        let hidden = time.logarithmic && first[0] <= 0.0 && first[1].is_finite() && !shown;
        hidden.then_some(first[1])
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Frame, StepLog};

    /// Frames and steps at these times with these values, which are energies and lengths alike.
    fn panel(frames: &[[f64; 2]], steps: &[[f64; 2]]) -> HistoryPanel {
        let frame =
            |&[time, value]: &[f64; 2]| Frame { time, energy: value, length: value, ..Frame::default() };
        let column = |k: usize| steps.iter().map(|step| step[k]).collect();
        let steps = StepLog { time: column(0), energy: column(1), ..StepLog::default() };
        HistoryPanel::new(&Record::of_frames_and_steps(frames.iter().map(frame).collect(), steps))
    }

    #[test]
    fn on_a_linear_axis_everything_stands_at_its_time() {
        let frames = [[0.0, 3.0], [5e-4, 2.0], [1e-3, 1.0]];
        let HistoryPanel { time, energy, length } = panel(&frames, &frames[1..]);
        assert!(!time.logarithmic);
        assert_eq!((&energy.points[..], &length.points[..]), (&frames[..], &frames[..]));
        assert_eq!((length.start(time), length.sparse(time)), (None, frames.to_vec()));
        let one_step = panel(&[frames[0], frames[2]], &[frames[2]]);
        assert_eq!(one_step.length.points, [frames[0], frames[2]]);
    }

    /// The length is known at the start and at the end, the energy in between too.
    #[test]
    fn on_a_logarithmic_axis_no_line_leads_from_time_zero_to_a_late_frame() {
        let frames = [[0.0, 8.0], [1e12, 1.0]];
        let HistoryPanel { time, energy, length } =
            panel(&frames, &[[1e9, 8.0], [1e10, 7.9], [1e11, 4.0], [1e12, 1.0]]);
        assert!(time.logarithmic);
        assert_eq!(energy.points.len(), 5);
        assert_eq!((energy.start(time), energy.sparse(time).len()), (None, 3));
        assert_eq!((length.start(time), length.sparse(time)), (Some(8.0), vec![frames[1]]));
        assert!(!time.place(length.points[0][0]).is_finite());
    }

    #[test]
    fn the_start_is_told_by_the_steps_where_frames_outnumber_them() {
        let frames = [[0.0, 15.02], [5e-5, 13.15], [1e-4, 13.0], [1.5e-4, 12.9]];
        let history = panel(&frames, &[[1e-8, 15.019], [1e-6, 14.5]]);
        assert_eq!(history.time.place(1e-8), 0.0);
        assert_eq!(history.energy.points[1], [1e-8, 15.019]);
        // And by a ring where there are no steps.
        let unlogged = panel(&frames, &[]);
        assert_eq!(unlogged.energy.start(Axis::logarithmic(5e-5, 1.0)), Some(15.02));
    }

    #[test]
    fn odd_histories_have_panels() {
        for frames in [&[][..], &[[0.0, 1.0]], &[[f64::NAN, f64::NAN]; 3], &[[0.0, f64::NAN], [1e9, 1.0]]] {
            let HistoryPanel { time, energy, length } = panel(frames, frames);
            assert!(energy.start(time).is_none() && length.sparse(time).len() <= frames.len());
        }
    }
}
