//! Text as outlines, from fonts inside the program: `DejaVu Sans`, upright and oblique, with Greek and mathematics.

use std::sync::LazyLock;

use ttf_parser::{Face, FaceParsingError, OutlineBuilder};

use super::colour_map::{Colour, INK};
use super::drawing::{Drawing, Ink, Piece, Point};

type ParsedFace = Result<Face<'static>, FaceParsingError>;

static UPRIGHT: LazyLock<ParsedFace> =
    LazyLock::new(|| Face::parse(include_bytes!("../../../assets/DejaVuSans-subset.ttf"), 0));
static OBLIQUE: LazyLock<ParsedFace> =
    LazyLock::new(|| Face::parse(include_bytes!("../../../assets/DejaVuSans-Oblique-subset.ttf"), 0));

/// Text of one line; variables are oblique.
#[derive(Clone, Debug, Default)]
pub(super) struct Text(Vec<(String, bool)>);

impl Text {
    /// Upright text.
    pub fn plain(text: impl Into<String>) -> Self {
        Self(vec![(text.into(), false)])
    }

    /// The name of a variable, appended.
    pub fn variable(mut self, name: &str) -> Self {
        self.0.push((name.to_owned(), true));
        self
    }

    /// Upright text, appended.
    pub fn and(mut self, text: &str) -> Self {
        self.0.push((text.to_owned(), false));
        self
    }

    /// Width in pixels at a font size.
    pub fn width(&self, size: f64) -> f64 {
        self.glyphs(size, |_, _, _| {})
    }

    /// Calls `place` with each glyph and where it starts; returns the width.
    fn glyphs(&self, size: f64, mut place: impl FnMut(&Face<'static>, ttf_parser::GlyphId, f64)) -> f64 {
        let mut x = 0.0;
        for (text, oblique) in &self.0 {
            let Ok(face) = (if *oblique { &*OBLIQUE } else { &*UPRIGHT }) else { continue };
            for character in text.chars() {
                let glyph = face.glyph_index(character).unwrap_or_default(); // the box of a missing glyph
                place(face, glyph, x);
                x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * size
                    / f64::from(face.units_per_em());
            }
        }
        x
    }
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// How a text is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub size: f64,
    pub align: Align,
    pub colour: Colour,
    /// Written from bottom to top.
    pub upwards: bool,
}

impl Style {
    pub const fn new(size: f64, align: Align) -> Self {
        Self { size, align, colour: INK, upwards: false }
    }

    pub const fn coloured(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub const fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// Writes `text` with its middle line (half the height of a digit) at `at`.
pub(super) fn write(drawing: &mut Drawing, at: Point, text: &Text, style: Style) {
    let width = text.width(style.size);
    let start = match style.align {
        Align::Left => 0.0,
        Align::Centre => -0.5 * width,
        Align::Right => -width,
    };
    let baseline = 0.36 * style.size;
    let mut pen = Pen { outline: Vec::new() };
    let mut outline = Vec::new();
    text.glyphs(style.size, |face, glyph, x| {
        let scale = style.size / f64::from(face.units_per_em());
        face.outline_glyph(glyph, &mut pen);
        let place = |[u, v]: Point| {
            let (along, across) = (start + x + scale * u, baseline - scale * v);
            if style.upwards { [at[0] + across, at[1] - along] } else { [at[0] + along, at[1] + across] }
        };
        outline.extend(pen.outline.drain(..).map(|piece| piece.map(place)));
    });
    drawing.add(outline, Ink::Fill(style.colour));
}

struct Pen {
    outline: Vec<Piece>,
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.outline.push(Piece::Move([x.into(), y.into()]));
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.outline.push(Piece::Line([x.into(), y.into()]));
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.outline.push(Piece::Quadratic([x1.into(), y1.into()], [x.into(), y.into()]));
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.outline.push(Piece::Cubic([x1.into(), y1.into()], [x2.into(), y2.into()], [x.into(), y.into()]));
    }
    fn close(&mut self) {
        self.outline.push(Piece::Close);
    }
}
