//! A drawing: outlines with ink, in pixels from the top left corner, before it becomes SVG or PNG.

use super::colour_map::Colour;

/// A point in pixels, y downwards.
pub(super) type Point = [f64; 2];

/// One piece of an outline.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    Move(Point),
    Line(Point),
    Quadratic(Point, Point),
    Cubic(Point, Point, Point),
    Close,
}

impl Piece {
    /// The same piece with all its points moved by `map`.
    pub fn map(self, map: impl Fn(Point) -> Point) -> Self {
        match self {
            Self::Move(p) => Self::Move(map(p)),
            Self::Line(p) => Self::Line(map(p)),
            Self::Quadratic(a, p) => Self::Quadratic(map(a), map(p)),
            Self::Cubic(a, b, p) => Self::Cubic(map(a), map(b), map(p)),
            Self::Close => Self::Close,
        }
    }
}

/// How an outline is inked. Strokes have round joins and caps.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ink {
    Fill(Colour),
    Stroke { colour: Colour, width: f64, dash: Option<[f64; 2]> },
}

impl Ink {
    /// A solid line.
    pub const fn line(colour: Colour, width: f64) -> Self {
        Self::Stroke { colour, width, dash: None }
    }

    /// A dashed line; round caps make the dashes longer by the width.
    pub const fn dashed(colour: Colour, width: f64, dash: f64, gap: f64) -> Self {
        Self::Stroke { colour, width, dash: Some([dash, gap]) }
    }
}

/// A rectangle in pixels.
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

/// Everything on the page, in the order of drawing.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pub width: f64,
    pub height: f64,
    pub items: Vec<(Vec<Piece>, Ink)>,
}

impl Drawing {
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, items: Vec::new() }
    }

    pub fn add(&mut self, outline: Vec<Piece>, ink: Ink) {
        if !outline.is_empty() {
            self.items.push((outline, ink));
        }
    }

    pub fn line(&mut self, from: Point, to: Point, ink: Ink) {
        self.add(vec![Piece::Move(from), Piece::Line(to)], ink);
    }

    pub fn rectangle(&mut self, rect: &Rect, ink: Ink) {
        let corners = [[rect.right, rect.top], [rect.right, rect.bottom], [rect.left, rect.bottom]];
        let mut outline = vec![Piece::Move([rect.left, rect.top])];
        outline.extend(corners.map(Piece::Line));
        outline.push(Piece::Close);
        self.add(outline, ink);
    }
}
