//! The page: lengths in pixels of a page of 1600 × 900, lines with round joins, text and legends.

use plotters::element::{Circle, DashedPathElement, DottedPathElement, PathElement};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width and height; images are scaled from it.
pub(super) const SIZE: [f64; 2] = [1600.0, 900.0];
/// Name under which the fonts of `assets` are known to `plotters` and, in SVG files, to the viewer.
pub(super) const FONT: &str = "DejaVu Sans, sans-serif";
/// Font size of ticks and legends, of axis labels, and of the title.
pub(super) const SMALL: f64 = 22.0;
pub(super) const MEDIUM: f64 = 24.0;
pub(super) const LARGE: f64 = 30.0;
/// Line height of the font in units of its size; `plotters` counts font sizes so.
const LINE_HEIGHT: f64 = 1.164;

/// Height that a title takes.
const TITLE: f64 = 56.0;

/// Width of the white around text on lines, and the directions in which the text is drawn for it.
const HALO: f64 = 2.5;
const AROUND: [[f64; 2]; 8] =
    [[1.0, 0.0], [0.7, 0.7], [0.0, 1.0], [-0.7, 0.7], [-1.0, 0.0], [-0.7, -0.7], [0.0, -1.0], [0.7, -0.7]];

/// Height of a mark that stands for what lies below.
pub(super) const MARK: f64 = 15.0;

/// Width of the line of a ring.
const RING: f64 = 2.5;

/// Axes and text.
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// The initial state.
pub(super) const FAINT: RGBColor = RGBColor(0x80, 0x80, 0x80);
/// Grid lines.
pub(super) const GRID: RGBColor = RGBColor(0xE4, 0xE4, 0xE4);
// Okabe and Ito's set, safe for colour-blind readers.
pub(super) const SKY: RGBColor = RGBColor(0x00, 0x72, 0xB2);
pub(super) const VERMILION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
pub(super) const SEA: RGBColor = RGBColor(0x00, 0x9E, 0x73);
pub(super) const ORANGE: RGBColor = RGBColor(0xE6, 0x9F, 0x00);
pub(super) const ROSE: RGBColor = RGBColor(0xCC, 0x79, 0xA7);

/// Result of drawing on the back end `DB`.
pub(super) type Drawn<DB, T = ()> = Result<T, DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// Pattern of a line; lengths in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pattern {
    Solid,
    Dashes { dash: f64, gap: f64 },
    Dots { spacing: f64 },
}

/// Look of a line; lengths in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    pub colour: RGBColor,
    pub width: f64,
    pub pattern: Pattern,
}

impl Pen {
    pub const fn solid(colour: RGBColor, width: f64) -> Self {
        Self { colour, width, pattern: Pattern::Solid }
    }

    /// Length of a sample in a legend: two dashes at least.
    pub fn sample(self) -> f64 {
        const SAMPLE: f64 = 38.0;
        match self.pattern {
            Pattern::Dashes { dash, gap } => SAMPLE.max(2.0 * dash + gap),
            _ => SAMPLE,
        }
    }

    pub const fn dashed(colour: RGBColor, width: f64, dash: f64, gap: f64) -> Self {
        Self { colour, width, pattern: Pattern::Dashes { dash, gap } }
    }
}

/// What all panels draw on.
pub(super) struct Page<DB: DrawingBackend> {
    pub root: DrawingArea<DB, plotters::coord::Shift>,
    /// Back end pixels per page pixel.
    pub scale: f64,
    /// How far centred text has to be lowered, in units of its size: back ends place it differently.
    pub text_drop: f64,
}

impl<DB: DrawingBackend> Page<DB> {
    /// A length in pixels of the back end.
    pub fn px(&self, length: f64) -> i32 {
        (length * self.scale).round() as i32
    }

    /// The style of text of `size`.
    pub fn font(&self, size: f64, colour: RGBColor) -> TextStyle<'static> {
        (FONT, size * LINE_HEIGHT * self.scale).with_color(colour).into_text_style(&self.root)
    }

    /// How far centred text of `size` has to be lowered, in pixels of the back end.
    pub fn drop(&self, size: f64) -> i32 {
        self.px(self.text_drop * size)
    }

    /// Width of `text`.
    pub fn width(&self, text: &str, size: f64) -> Drawn<DB, f64> {
        let (width, _) = self.root.estimate_text_size(text, &self.font(size, INK))?;
        Ok(f64::from(width) / self.scale)
    }

    /// One line of text, vertically centred at `at`.
    pub fn text(&self, text: &str, size: f64, [x, y]: [f64; 2], align: HPos) -> Drawn<DB> {
        let style = self.font(size, INK).pos(Pos::new(align, VPos::Center));
        self.root.draw_text(text, &style, (self.px(x), self.px(y) + self.drop(size)))
    }

    /// Text as [`text`](Self::text) writes it, legible on top of lines.
    pub fn text_on_lines(&self, text: &str, size: f64, [x, y]: [f64; 2], align: HPos) -> Drawn<DB> {
        let style = self.font(size, WHITE).pos(Pos::new(align, VPos::Center));
        for [right, down] in AROUND {
            let at = (self.px(x + HALO * right), self.px(y + HALO * down) + self.drop(size));
            self.root.draw_text(text, &style, at)?;
        }
        self.text(text, size, [x, y], align)
    }

    /// The title of the page, cut if it is too long for it. Returns the height that it leaves free: all of its own if it is empty.
    pub fn title(&self, title: &str) -> Drawn<DB, f64> {
        let text = self.cut(title, LARGE, SIZE[0] - 80.0)?;
        if text.trim().is_empty() {
            return Ok(TITLE);
        }
        self.text(&text, LARGE, [0.5 * SIZE[0], 38.0], HPos::Center)?;
        Ok(0.0)
    }

    /// What an axis of the density `name` is called, cut to be at most `room` long, with a power of ten as units.
    pub fn density(&self, name: &str, room: f64) -> Drawn<DB, String> {
        let rest = self.width(" density ρ  [10⁻¹⁵]", MEDIUM)?;
        Ok(format!("{} density ρ", self.cut(name, MEDIUM, room - rest)?))
    }

    /// As much of `text` as is at most `width` wide.
    pub fn cut(&self, text: &str, size: f64, width: f64) -> Drawn<DB, String> {
        // Control characters are not allowed in SVG.
        let mut left: Vec<char> = text.chars().filter(|c| !c.is_control()).collect();
        let mut text: String = left.iter().collect();
        while self.width(&text, size)? > width && left.pop().is_some() {
            text = left.iter().chain(['…'].iter()).collect();
        }
        Ok(text)
    }

    /// A line through `points` of the back end.
    pub fn line(&self, points: Vec<(i32, i32)>, pen: Pen) -> Drawn<DB> {
        let width = self.px(pen.width).max(1);
        let (path, dot) = (pen.colour.stroke_width(width as u32), pen.colour.filled());
        match pen.pattern {
            Pattern::Solid => {
                for ends in points.windows(2).filter(|ends| ends[0] != ends[1]) {
                    self.root.draw(&PathElement::new(ends, path))?;
                }
                // Rounds the joins.
                points.into_iter().try_for_each(|at| self.root.draw(&Circle::new(at, width / 2, dot)))
            }
            Pattern::Dashes { dash, gap } => {
                self.root.draw(&DashedPathElement::new(points, self.px(dash), self.px(gap), path))
            }
            Pattern::Dots { spacing } => {
                let marker = move |at| Circle::new(at, width / 2, dot);
                self.root.draw(&DottedPathElement::new(points, 0, self.px(spacing), marker))
            }
        }
    }

    /// A ring around a pixel of the back end.
    pub fn ring(&self, at: (i32, i32), radius: f64, colour: RGBColor) -> Drawn<DB> {
        self.root.draw(&Circle::new(at, self.px(radius), colour.filled()))?;
        self.root.draw(&Circle::new(at, self.px(radius - RING), WHITE.filled()))
    }

    /// A triangle whose tip points down at a pixel of the back end.
    pub fn mark_below(&self, (x, y): (i32, i32), colour: RGBColor) -> Drawn<DB> {
        let (half, height) = (self.px(0.6 * MARK), self.px(MARK));
        let corners = vec![(x - half, y - height), (x + half, y - height), (x, y)];
        self.root.draw(&Polygon::new(corners, colour.filled()))
    }

    /// A row of samples, starting at `at`: above a panel it hides nothing. Returns where the next one has its place.
    pub fn legend(&self, [mut x, y]: [f64; 2], entries: &[(Pen, &str)]) -> Drawn<DB, [f64; 2]> {
        for (pen, text) in entries {
            self.line(vec![(self.px(x), self.px(y)), (self.px(x + pen.sample()), self.px(y))], *pen)?;
            x += pen.sample() + 9.0;
            self.text(text, SMALL, [x, y], HPos::Left)?;
            x += self.width(text, SMALL)? + 20.0;
        }
        Ok([x, y])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_of_a_dashed_line_has_two_whole_dashes() {
        assert_eq!(Pen::solid(INK, 4.0).sample(), 38.0);
        assert_eq!(Pen::dashed(INK, 4.0, 24.0, 12.0).sample(), 60.0);
    }
}
