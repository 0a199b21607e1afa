//! The figure: a title and three panels.

use std::path::{Path, PathBuf};

use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::HPos;

use super::page::{Drawn, LARGE, Page, SIZE};
use super::panel::Rect;
use super::render::{self, Draw, Failure};
use super::{curve_panel, history_panel, state_panel};
use crate::output::{StorageError, atomic_file};
use crate::run::{Frame, Record};

/// Widths of an image.
const WIDTHS: std::ops::RangeInclusive<u32> = 200..=8000;

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

/// Why a figure could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum PictureError {
    /// The name of the file does not end in `.png` or `.svg`.
    #[error("{}: the name of a figure ends in .png or .svg", .path.display())]
    Format { path: PathBuf },
    /// The record holds no state.
    #[error("the run has no saved state to draw: run the scene again")]
    NoFrames,
    /// The image would be too small to read or too large for memory.
    #[error("cannot draw an image of {width} pixels width: choose 200 to 8000")]
    Size { width: u32 },
    /// The drawing itself failed.
    #[error("cannot draw the figure")]
    Drawing { source: Failure },
    /// The file could not be written.
    #[error(transparent)]
    Storage(#[from] StorageError),
}

/// Draws `record` into the file `path`, whose name ends in `.png` or `.svg`.
/// # Errors
/// [`PictureError`]; the target is then as it was.
pub fn plot(record: &Record, path: &Path, options: &Options) -> Result<(), PictureError> {
    let (first, last) = record.frames.first().zip(record.frames.last()).ok_or(PictureError::NoFrames)?;
    let (width, lines) = (options.width, options.nodal_lines.as_ref());
    if !WIDTHS.contains(&width) {
        return Err(PictureError::Size { width });
    }
    let figure = Figure { record, first, last, lines };
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    let drawn = match extension.as_ref().and_then(|extension| extension.to_str()) {
        Some("svg") => render::svg(width, &figure).map(String::into_bytes),
        Some("png") => render::png(width, &figure),
        _ => return Err(PictureError::Format { path: path.to_path_buf() }),
    };
    let bytes = drawn.map_err(|source| PictureError::Drawing { source })?;
    Ok(atomic_file::write(path, &bytes, options.replace)?)
}

struct Figure<'a> {
    record: &'a Record,
    first: &'a Frame,
    last: &'a Frame,
    lines: Option<&'a NodalLines>,
}

impl Draw for Figure<'_> {
    fn draw<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB> {
        write_title(page, &self.record.title)?;
        let left = Rect { left: 112.0, top: 118.0, right: 782.0, bottom: 820.0 };
        curve_panel::draw(page, left, self.record, self.first, self.last)?;
        let upper = Rect { left: 1042.0, top: 118.0, right: 1480.0, bottom: 398.0 };
        state_panel::draw(page, upper, self.first, self.last, self.lines)?;
        let lower = Rect { top: 540.0, bottom: 820.0, ..upper };
        history_panel::draw(page, lower, self.record)
    }
}

/// Writes the title, cut if it is too long for the page.
fn write_title<DB: DrawingBackend>(page: &Page<DB>, title: &str) -> Drawn<DB> {
    // Control characters are not allowed in SVG.
    let mut title: Vec<char> = title.chars().filter(|c| !c.is_control()).collect();
    let mut text: String = title.iter().collect();
    while page.width(&text, LARGE)? > SIZE[0] - 80.0 {
        title.pop();
        text = title.iter().chain(['…'].iter()).collect();
    }
    page.text(&text, LARGE, [0.5 * SIZE[0], 38.0], HPos::Center)
}
