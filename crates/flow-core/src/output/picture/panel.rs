//! A panel: a frame with two axes, into which lines are drawn, clipped at the frame.

use super::axis::{Axis, power_of_ten};
use super::colour_map::{Colour, GRID, INK};
use super::drawing::{Drawing, Ink, Piece, Point, Rect};
use super::font::{Align, Style, Text, write};

/// Font size of tick labels, legends and the like, of axis labels, and of the title.
pub(super) const SMALL: f64 = 22.0;
pub(super) const MEDIUM: f64 = 24.0;
pub(super) const LARGE: f64 = 29.0;
const TICK: f64 = 8.0;

/// A frame with a horizontal and a vertical axis.
pub(super) struct Panel {
    pub frame: Rect,
    pub x: Axis,
    pub y: Axis,
}

impl Panel {
    /// Grid, ticks and labels; returns nothing, since the frame is fixed.
    pub fn draw_axes(&self, drawing: &mut Drawing, x_label: &Text, y_label: &Text) {
        for (value, _) in &self.x.ticks {
            let x = self.at([*value, f64::NAN])[0];
            drawing.line([x, self.frame.bottom], [x, self.frame.top], Ink::line(GRID, 1.2));
        }
        for (value, _) in &self.y.ticks {
            let y = self.at([f64::NAN, *value])[1];
            drawing.line([self.frame.left, y], [self.frame.right, y], Ink::line(GRID, 1.2));
        }
        self.draw_horizontal(drawing, x_label);
        draw_vertical(drawing, &self.frame, &self.y, y_label, Side::Left, INK);
    }

    /// The frame, on top of what was drawn.
    pub fn draw_frame(&self, drawing: &mut Drawing) {
        drawing.rectangle(&self.frame, Ink::line(INK, 1.8));
    }

    /// Point of the page that belongs to a pair of values.
    pub fn at(&self, [x, y]: Point) -> Point {
        let frame = &self.frame;
        [frame.left + self.x.place(x) * frame.width(), frame.bottom - self.y.place(y) * frame.height()]
    }

    /// A line through `points`, which are values; it breaks where it leaves the frame or is not finite.
    pub fn line(&self, drawing: &mut Drawing, points: impl IntoIterator<Item = Point>, ink: Ink) {
        let mut outline = Vec::new();
        let mut last: Option<Point> = None;
        let mut pen: Option<Point> = None;
        for point in points {
            let point = Some(self.at(point)).filter(|[x, y]| x.is_finite() && y.is_finite());
            if let (Some(from), Some(to)) = (last, point)
                && let Some([from, to]) = clipped(from, to, &self.frame)
            {
                if pen != Some(from) {
                    outline.push(Piece::Move(from));
                }
                outline.push(Piece::Line(to));
                pen = Some(to);
            }
            last = point;
        }
        drawing.add(outline, ink);
    }

    fn draw_horizontal(&self, drawing: &mut Drawing, label: &Text) {
        let bottom = self.frame.bottom;
        for (value, text) in &self.x.ticks {
            let x = self.at([*value, f64::NAN])[0];
            drawing.line([x, bottom], [x, bottom + TICK], Ink::line(INK, 1.8));
            write(drawing, [x, bottom + 24.0], &Text::plain(text), Style::new(SMALL, Align::Centre));
        }
        for value in &self.x.minor {
            let x = self.at([*value, f64::NAN])[0];
            drawing.line([x, bottom], [x, bottom + 0.55 * TICK], Ink::line(INK, 1.2));
        }
        let centre = 0.5 * (self.frame.left + self.frame.right);
        let label = with_exponent(label, self.x.exponent);
        write(drawing, [centre, bottom + 56.0], &label, Style::new(MEDIUM, Align::Centre));
    }
}

/// Side of a vertical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    Left,
    Right,
}

/// Ticks and labels of a vertical axis beside `frame`.
pub(super) fn draw_vertical(
    drawing: &mut Drawing,
    frame: &Rect,
    axis: &Axis,
    label: &Text,
    side: Side,
    colour: Colour,
) {
    let (edge, out, align) =
        if side == Side::Left { (frame.left, -1.0, Align::Right) } else { (frame.right, 1.0, Align::Left) };
    let mut widest: f64 = 0.0;
    for (value, text) in &axis.ticks {
        let y = frame.bottom - axis.place(*value) * frame.height();
        let text = Text::plain(text);
        widest = widest.max(text.width(SMALL));
        drawing.line([edge, y], [edge + out * TICK, y], Ink::line(INK, 1.8));
        write(drawing, [edge + out * (TICK + 6.0), y], &text, Style::new(SMALL, align).coloured(colour));
    }
    let x = edge + out * (TICK + 6.0 + widest + 12.0 + 0.5 * MEDIUM);
    let style = Style::new(MEDIUM, Align::Centre).coloured(colour).upwards();
    write(drawing, [x, 0.5 * (frame.top + frame.bottom)], &with_exponent(label, axis.exponent), style);
}

/// The label with the power of ten that the ticks leave out.
fn with_exponent(label: &Text, exponent: i32) -> Text {
    if exponent == 0 { label.clone() } else { label.clone().and(&format!("  [{}]", power_of_ten(exponent))) }
}

/// The part of a segment inside `frame` (Liang and Barsky).
fn clipped(from: Point, to: Point, frame: &Rect) -> Option<[Point; 2]> {
    let (low, high) = ([frame.left, frame.top], [frame.right, frame.bottom]);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for k in 0..2 {
        let step = to[k] - from[k];
        if step == 0.0 {
            if !(low[k]..=high[k]).contains(&from[k]) {
                return None;
            }
            continue;
        }
        let (a, b) = ((low[k] - from[k]) / step, (high[k] - from[k]) / step);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    let along = |s: f64| {
        // The ends themselves stay exact, so that a line inside the frame is one stroke.
        if s == 0.0 {
            from
        } else if s == 1.0 {
            to
        } else {
            [from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])]
        }
    };
    (enter <= leave).then(|| [along(enter), along(leave)])
}
