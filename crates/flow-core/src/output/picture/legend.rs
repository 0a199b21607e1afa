//! A legend: one row of samples above a panel, where it hides nothing.

use super::drawing::{Drawing, Ink, Point};
use super::font::{Align, Style, Text, write};
use super::panel::SMALL;

const SAMPLE: f64 = 38.0;
const GAP: f64 = 9.0;
const SPACE: f64 = 20.0;

/// Draws `entries` from left to right, starting at `at`.
pub(super) fn draw(drawing: &mut Drawing, at: Point, entries: &[(Ink, Text)]) {
    let [mut x, y] = at;
    for (ink, text) in entries {
        drawing.line([x, y], [x + SAMPLE, y], *ink);
        x += SAMPLE + GAP;
        write(drawing, [x, y], text, Style::new(SMALL, Align::Left));
        x += text.width(SMALL) + SPACE;
    }
}
