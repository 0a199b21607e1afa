//! The page: a title and three panels.

use std::path::{Path, PathBuf};

use super::drawing::{Drawing, Rect};
use super::font::{Align, Style, Text, write};
use super::panel::LARGE;
use super::{bitmap, curve_panel, history_panel, state_panel, svg};
use crate::output::{StorageError, atomic_file};
use crate::run::Record;

/// Size of the page; PNG files are scaled from it.
const PAGE: [f64; 2] = [1600.0, 900.0];

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
    /// The image cannot be that large, or cannot have no pixels.
    #[error("cannot paint an image of {width} pixels width; try 1600")]
    Size { width: u32 },
    /// The file could not be written.
    #[error(transparent)]
    Storage(#[from] StorageError),
}

/// Draws `record` into the file `path`, whose name ends in `.png` or `.svg`.
/// # Errors
/// [`PictureError`]; the target is then as it was.
pub fn plot(record: &Record, path: &Path, options: &Options) -> Result<(), PictureError> {
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    let bytes = match extension.as_ref().and_then(|extension| extension.to_str()) {
        Some("svg") => svg::document(&figure(record, options)?, &record.title, options.width).into_bytes(),
        Some("png") => bitmap::png(&figure(record, options)?, options.width)
            .ok_or(PictureError::Size { width: options.width })?,
        _ => return Err(PictureError::Format { path: path.to_path_buf() }),
    };
    Ok(atomic_file::write(path, &bytes, options.replace)?)
}

fn figure(record: &Record, options: &Options) -> Result<Drawing, PictureError> {
    let (first, last) = record.frames.first().zip(record.frames.last()).ok_or(PictureError::NoFrames)?;
    let mut drawing = Drawing::new(PAGE[0], PAGE[1]);
    write_title(&mut drawing, &record.title);
    let left = Rect { left: 112.0, top: 118.0, right: 782.0, bottom: 820.0 };
    curve_panel::draw(&mut drawing, left, record, first, last);
    let upper = Rect { left: 1042.0, top: 118.0, right: 1480.0, bottom: 398.0 };
    state_panel::draw(&mut drawing, upper, first, last, options.nodal_lines.as_ref());
    let lower = Rect { top: 540.0, bottom: 820.0, ..upper };
    history_panel::draw(&mut drawing, lower, record);
    Ok(drawing)
}

/// Writes the title, cut if it is too long for the page.
fn write_title(drawing: &mut Drawing, title: &str) {
    let room = PAGE[0] - 80.0;
    let mut text = Text::plain(title);
    let mut length = title.chars().count();
    while text.width(LARGE) > room && length > 0 {
        length -= 1;
        text = Text::plain(title.chars().take(length).chain(['…']).collect::<String>());
    }
    write(drawing, [0.5 * PAGE[0], 38.0], &text, Style::new(LARGE, Align::Centre));
}
