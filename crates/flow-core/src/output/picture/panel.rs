//! A panel: a chart of `plotters` at a fixed place, into which lines are drawn, clipped at the frame.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::{Axis, LABELS};
use super::page::{Drawn, GRID, INK, MARK, MEDIUM, Page, Pen, SMALL};

/// Room below a frame for labels and a name.
const BELOW: f64 = 74.0;
const TICK: f64 = 7.0;
/// Between a frame and its labels, as `plotters` has it; between labels and the name of an axis; between neighbouring labels.
const TO_LABELS: f64 = 2.0 * TICK;
const TO_NAME: f64 = 8.0;
const APART: f64 = 16.0;
/// Height of the name of an axis.
const NAME: f64 = 1.2 * MEDIUM;
/// Points of a line closer than this are merged.
const CLOSE: f64 = 2.5;

/// Place of a frame on the page, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }
}

/// An axis and its name.
pub(super) type Named<'a> = (Axis, &'a str);

/// A frame with two axes.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    x: Axis,
    y: Axis,
    /// The frame, in pixels of the back end.
    pixels: (Range<i32>, Range<i32>),
}

impl Panel {
    /// Room beside a frame for the labels of a vertical axis and for its name.
    pub fn room<DB: DrawingBackend>(page: &Page<DB>, axis: Axis) -> Drawn<DB, f64> {
        let mut widest = 0.0_f64;
        for value in axis.ticks() {
            widest = widest.max(page.width(&axis.label(value), SMALL)?);
        }
        Ok(TO_LABELS + widest + TO_NAME + NAME)
    }

    /// Draws grid, ticks and labels.
    pub fn new<DB: DrawingBackend>(
        page: &Page<DB>,
        frame: Rect,
        (x, x_name): Named<'_>,
        (y, y_name): Named<'_>,
    ) -> Drawn<DB, Self> {
        let (x, room) = (labelled(page, x, frame.width())?, Self::room(page, y)?);
        let area = page.root.clone().shrink(
            (page.px(frame.left - room), page.px(frame.top)),
            (page.px(frame.width() + room), page.px(frame.height() + BELOW)),
        );
        let mut chart = ChartBuilder::on(&area)
            .set_label_area_size(LabelAreaPosition::Left, page.px(room))
            .set_label_area_size(LabelAreaPosition::Bottom, page.px(BELOW))
            .build_cartesian_2d(x, y)?;
        let pixels = chart.plotting_area().get_pixel_range();
        // Any number that is larger than that of the labels.
        let light_lines = |axis: Axis| if axis.logarithmic { 10 } else { 0 };
        chart
            .configure_mesh()
            .x_labels(LABELS)
            .y_labels(LABELS)
            .x_max_light_lines(light_lines(x))
            .y_max_light_lines(light_lines(y))
            .x_label_formatter(&|value| x.label(*value))
            .y_label_formatter(&|value| y.label(*value))
            .y_label_offset(page.drop(SMALL))
            .bold_line_style(GRID.stroke_width(page.px(1.0) as u32))
            .light_line_style(GRID.mix(0.5))
            .axis_style(INK.stroke_width(page.px(1.5) as u32))
            .set_all_tick_mark_size(page.px(TICK))
            .label_style(page.font(SMALL, INK))
            .axis_desc_style(page.font(MEDIUM, INK))
            .x_desc(x.title(x_name))
            .y_desc(y.title(y_name))
            .draw()?;
        Ok(Self { x, y, pixels })
    }

    /// A frame with an axis on its right only.
    pub fn right<DB: DrawingBackend>(
        page: &Page<DB>,
        frame: Rect,
        x: Axis,
        (y, name): Named<'_>,
        colour: RGBColor,
    ) -> Drawn<DB, Self> {
        let room = Self::room(page, y)?;
        let area = page.root.clone().shrink(
            (page.px(frame.left), page.px(frame.top)),
            (page.px(frame.width() + room), page.px(frame.height())),
        );
        let mut chart = ChartBuilder::on(&area)
            .set_label_area_size(LabelAreaPosition::Right, page.px(room))
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .disable_x_axis()
            .y_labels(LABELS)
            .y_label_formatter(&|value| y.label(*value))
            .y_label_offset(page.drop(SMALL))
            .axis_style(INK.stroke_width(page.px(1.5) as u32))
            .set_all_tick_mark_size(page.px(TICK))
            .label_style(page.font(SMALL, colour))
            .axis_desc_style(page.font(MEDIUM, colour))
            .y_desc(y.title(name))
            .draw()?;
        Ok(Self { x, y, pixels: chart.plotting_area().get_pixel_range() })
    }

    /// The frame, on top of what was drawn.
    pub fn draw_frame<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB> {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        page.line(corners.map(|place| self.pixel(place)).to_vec(), Pen::solid(INK, 2.0))
    }

    /// Dots at those of `points` that lie within the frame.
    pub fn dots<DB: DrawingBackend>(
        &self,
        page: &Page<DB>,
        points: impl IntoIterator<Item = [f64; 2]>,
        colour: RGBColor,
        radius: f64,
    ) -> Drawn<DB> {
        let places = points.into_iter().map(|[x, y]| [self.x.place(x), self.y.place(y)]);
        let inside = places.filter(|place| place.iter().all(|place| (0.0..=1.0).contains(place)));
        inside.into_iter().try_for_each(|place| {
            page.root.draw(&Circle::new(self.pixel(place), page.px(radius), colour.filled()))
        })
    }

    /// Marks that point down, one on the other at the lower edge of the frame, for what lies below it at `x`.
    pub fn marks_below<DB: DrawingBackend>(
        &self,
        page: &Page<DB>,
        x: f64,
        colours: impl IntoIterator<Item = RGBColor>,
    ) -> Drawn<DB> {
        let (x, mut y) = self.pixel([self.x.place(x), 0.0]);
        colours.into_iter().try_for_each(|colour| {
            page.mark_below((x, y), colour)?;
            y -= page.px(MARK);
            Ok(())
        })
    }

    /// Text to the upper right of a point, if that lies within the frame: lines that fall leave it free.
    pub fn label<DB: DrawingBackend>(&self, page: &Page<DB>, [x, y]: [f64; 2], text: &str) -> Drawn<DB> {
        let place = [self.x.place(x), self.y.place(y)];
        if !place.iter().all(|place| (0.0..=1.0).contains(place)) {
            return Ok(());
        }
        let (x, y) = self.pixel(place);
        let at = [f64::from(x) / page.scale + 0.4 * SMALL, f64::from(y) / page.scale - 0.6 * SMALL];
        page.text_on_lines(text, SMALL, at, HPos::Left)
    }

    /// Pixel of the back end for a place in the unit square.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let (horizontal, vertical) = &self.pixels;
        let along = |from: i32, to: i32, place: f64| from + (f64::from(to - from) * place).round() as i32;
        (along(horizontal.start, horizontal.end, x), along(vertical.end, vertical.start, y))
    }

    /// A line through `points`, which are values; it breaks where it leaves the frame or is not finite.
    pub fn line<DB: DrawingBackend>(
        &self,
        page: &Page<DB>,
        points: impl IntoIterator<Item = [f64; 2]>,
        pen: Pen,
    ) -> Drawn<DB> {
        let close = (CLOSE * page.scale).powi(2) as i32;
        let mut piece: Vec<(i32, i32)> = Vec::new();
        let mut end = None;
        let mut last: Option<[f64; 2]> = None;
        for point in points {
            let place = [self.x.place(point[0]), self.y.place(point[1])];
            let place = Some(place).filter(|place| place.iter().all(|place| place.is_finite()));
            if let Some([from, to]) = last.zip(place).and_then(|(from, to)| clipped(from, to)) {
                let (from, to) = (self.pixel(from), self.pixel(to));
                if end != Some(from) {
                    piece.extend(end.take());
                    page.line(std::mem::take(&mut piece), pen)?;
                    piece.push(from);
                }
                if piece.last().is_none_or(|at| (at.0 - to.0).pow(2) + (at.1 - to.1).pow(2) >= close) {
                    piece.push(to);
                }
                end = Some(to);
            }
            last = place;
        }
        piece.extend(end);
        page.line(piece, pen)
    }
}

/// The horizontal `axis`, `length` long, with no more labels than stand beside each other.
fn labelled<DB: DrawingBackend>(page: &Page<DB>, axis: Axis, length: f64) -> Drawn<DB, Axis> {
    for labels in (3..=LABELS).rev() {
        let axis = axis.with_labels(labels);
        let mut end = f64::NEG_INFINITY;
        let mut fit = true;
        for value in axis.ticks() {
            let (at, half) = (length * axis.place(value), 0.5 * page.width(&axis.label(value), SMALL)?);
            fit &= at - half >= end + APART;
            end = at + half;
        }
        if fit {
            return Ok(axis);
        }
    }
    Ok(axis.with_labels(2))
}

/// The part of a segment inside the unit square (Liang and Barsky).
fn clipped(from: [f64; 2], to: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for k in 0..2 {
        let step = to[k] - from[k];
        if step == 0.0 {
            if !(0.0..=1.0).contains(&from[k]) {
                return None;
            }
            continue;
        }
        let (a, b) = (-from[k] / step, (1.0 - from[k]) / step);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    let along = |s: f64| [0, 1].map(|k| from[k] + s * (to[k] - from[k]));
    (enter <= leave).then(|| [along(enter), along(leave)])
}
