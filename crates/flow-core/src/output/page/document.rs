//! The HTML document: the page of `browser/` with the data of a record.

use std::path::{Path, PathBuf};

use super::payload::Payload;
use super::text::escaped;
use crate::output::rectangle::check_frames;
use crate::output::{StorageError, atomic_file};
use crate::run::Record;

const PAGE: &str = include_str!("browser/page.html");
const STYLE: &str = include_str!("browser/page.css");
/// The program of the page. The files share one scope; each uses only what stands before it.
const PROGRAM: [&str; 13] = [
    include_str!("browser/record.js"),
    include_str!("browser/numbers.js"),
    include_str!("browser/colours.js"),
    include_str!("browser/notation.js"),
    include_str!("browser/scale.js"),
    include_str!("browser/interpolant.js"),
    include_str!("browser/panel.js"),
    include_str!("browser/curve.js"),
    include_str!("browser/history.js"),
    include_str!("browser/trace.js"),
    include_str!("browser/tables.js"),
    include_str!("browser/player.js"),
    include_str!("browser/page.js"),
];

/// Why a page could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum PageError {
    /// The name of the file does not end in `.html`.
    #[error("{}: the name of a page ends in .html", .path.display())]
    Format { path: PathBuf },
    /// The record holds no state.
    #[error("the run has no saved state to show: run the scene again")]
    NoFrames,
    /// The file could not be written, or the frames do not fit together.
    #[error(transparent)]
    Storage(#[from] StorageError),
}

/// Writes the page of `record` to `path`; an existing file is replaced only if `replace`.
/// # Errors
/// [`PageError`]; the target is then as it was.
pub fn view(record: &Record, path: &Path, replace: bool) -> Result<(), PageError> {
    if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("html")) {
        return Err(PageError::Format { path: path.to_path_buf() });
    }
    Ok(atomic_file::write(path, html(record)?.as_bytes(), replace)?)
}

/// The page of `record`.
/// # Errors
/// [`PageError::NoFrames`], or [`StorageError::Ragged`] if a frame is not like the last one.
pub fn html(record: &Record) -> Result<String, PageError> {
    // Frames that do not fit together would be shown in each other's place.
    if record.frames.is_empty() {
        return Err(PageError::NoFrames);
    }
    check_frames(record)?;
    let payload = Payload::new(record);
    let title = escaped(&record.title);
    let mut parts = PAGE.split("{{");
    let mut document = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, text) = part.split_once("}}").unwrap_or((part, ""));
        match name {
            "title" => document.push_str(&title),
            "style" => document.push_str(STYLE),
            "program" => PROGRAM.iter().for_each(|file| document.push_str(file)),
            "summary" => document.push_str(&payload.summary),
            "centres" => document.push_str(&payload.centres),
            "positions" => document.push_str(&payload.positions),
            "fields" => document.push_str(&payload.fields),
            "history" => document.push_str(&payload.history),
            "energies" => document.push_str(&payload.energies),
            _ => unreachable!("page.html asks for {name}"),
        }
        document.push_str(text);
    }
    Ok(document)
}
