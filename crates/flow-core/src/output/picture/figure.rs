//! The figure: a title and three panels.

use std::path::Path;

use plotters::prelude::DrawingBackend;

use super::file::{self, PictureError};
use super::page::{Drawn, Page};
use super::panel::Rect;
use super::render::Draw;
use super::{curve_panel, history_panel, state_panel};
use crate::run::{Frame, Record};

/// Lines of the (ρ, κ) plane on which the energy of the agents vanishes, as samples (ρ, κ).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalLines {
    /// Preferred curvature κ₀(ρ).
    pub preferred_curvature: Vec<(f64, f64)>,
    /// Low density ρ₋(κ).
    pub low: Vec<(f64, f64)>,
    /// High density ρ₊(κ).
    pub high: Vec<(f64, f64)>,
}

/// How a figure is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Width in pixels; the height is 9/16 of it.
    pub width: u32,
    /// Whether an existing file may be replaced.
    pub replace: bool,
    /// Nodal lines of the energy, drawn with the final state.
    pub nodal_lines: Option<NodalLines>,
}

impl Default for Options {
    /// 1600 × 900 pixels, replacing nothing.
    fn default() -> Self {
        Self { width: 1600, replace: false, nodal_lines: None }
    }
}

/// Draws `record` into the file `path`, whose name ends in `.png` or `.svg`.
/// # Errors
/// [`PictureError`]; the target is then as it was.
pub fn plot(record: &Record, path: &Path, options: &Options) -> Result<(), PictureError> {
    let (first, last) = record.frames.first().zip(record.frames.last()).ok_or(PictureError::NoFrames)?;
    let figure = Figure { record, first, last, lines: options.nodal_lines.as_ref() };
    file::write(&figure, path, options.width, options.replace)
}

struct Figure<'a> {
    record: &'a Record,
    first: &'a Frame,
    last: &'a Frame,
    lines: Option<&'a NodalLines>,
}

impl Draw for Figure<'_> {
    fn draw<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB> {
        page.title(&self.record.title)?;
        let left = Rect { left: 112.0, top: 118.0, right: 782.0, bottom: 820.0 };
        curve_panel::draw(page, left, self.record, self.first, self.last)?;
        let upper = Rect { left: 1042.0, top: 118.0, right: 1480.0, bottom: 398.0 };
        state_panel::draw(page, upper, self.first, self.last, self.lines)?;
        let lower = Rect { top: 540.0, bottom: 820.0, ..upper };
        history_panel::draw(page, lower, self.record)
    }
}
