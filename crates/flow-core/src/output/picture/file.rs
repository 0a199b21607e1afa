//! The file of a figure: its format by its name.

use std::path::{Path, PathBuf};

use super::render::{self, Draw, Failure};
use crate::output::{StorageError, atomic_file};

/// Widths of an image.
const WIDTHS: std::ops::RangeInclusive<u32> = 200..=8000;

/// Why a figure could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum PictureError {
    /// The name of the file does not end in `.png` or `.svg`.
    #[error("{}: the name of a figure ends in .png or .svg", .path.display())]
    Format { path: PathBuf },
    /// The record has no density of this name.
    #[error("the run has no density `{name}`; {}", there(.densities))]
    NoDensity { name: String, densities: Vec<String> },
    /// The record holds no state.
    #[error("the run has no saved state to draw: run the scene again")]
    NoFrames,
    /// Every run of the ladder failed.
    #[error("no run of the ladder was measured, so there is nothing to draw: give it other tolerances")]
    NoRungs,
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

#[cold]
fn there(densities: &[String]) -> String {
    if densities.is_empty() {
        return "it has none, and its figure shows the curvature".to_owned();
    }
    format!("it has `{}`", densities.join("`, `"))
}

/// Checks that a figure can have the name `path`, so that a long run fails before it starts.
/// # Errors
/// [`PictureError::Format`] if it does not end in `.png` or `.svg`.
pub fn check_name(path: &Path) -> Result<(), PictureError> {
    Format::of(path).map(drop)
}

enum Format {
    Png,
    Svg,
}

impl Format {
    fn of(path: &Path) -> Result<Self, PictureError> {
        let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
        match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            _ => Err(PictureError::Format { path: path.to_path_buf() }),
        }
    }
}

/// Draws `figure`, `width` pixels wide, into the file `path`, whose name ends in `.png` or `.svg`.
pub(super) fn write(figure: &impl Draw, path: &Path, width: u32, replace: bool) -> Result<(), PictureError> {
    if !WIDTHS.contains(&width) {
        return Err(PictureError::Size { width });
    }
    let drawn = match Format::of(path)? {
        Format::Svg => render::svg(width, figure).map(String::into_bytes),
        Format::Png => render::png(width, figure),
    };
    let bytes = drawn.map_err(|source| PictureError::Drawing { source })?;
    Ok(atomic_file::write(path, &bytes, replace)?)
}
