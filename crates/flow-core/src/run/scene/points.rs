//! Points of a curve from a text file: two numbers per line.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Larger files are refused unread.
const MAX_BYTES: u64 = 4 << 20;

/// Why a file of points could not be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum PointsError {
    /// The file could not be read as text.
    #[error("{0}; paths start from the folder of the scene")]
    Unreadable(#[from] io::Error),
    /// A folder, a device or a pipe.
    #[error("it is not a plain file; give the name of a text file")]
    NotAFile,
    /// The file is too large.
    #[error("it is larger than {limit} bytes; thin the points out")]
    TooLarge { limit: u64 },
    /// A line does not hold two finite numbers.
    #[error(
        "line {line} (`{text}`) must hold two finite numbers, x and y, with a space or a comma between them"
    )]
    NotAPoint { line: usize, text: String },
}

/// Reads points: `x y` or `x, y` on each line; `#` starts a comment.
pub(super) fn read(path: &Path) -> Result<Vec<[f64; 2]>, PointsError> {
    // Asked before opening: opening a pipe would wait for its other end.
    if !std::fs::metadata(path)?.is_file() {
        return Err(PointsError::NotAFile);
    }
    let mut text = String::new();
    File::open(path)?.take(MAX_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(PointsError::TooLarge { limit: MAX_BYTES });
    }
    parse(&text)
}

/// Points from the text of such a file: `x y` or `x, y` on each line; `#` starts a comment.
///
/// # Errors
/// [`PointsError::NotAPoint`] for the first line that does not hold two finite numbers.
pub fn parse(text: &str) -> Result<Vec<[f64; 2]>, PointsError> {
    let content = |line: &str| line.split('#').next().unwrap_or("").trim().len();
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate().filter(|(_, line)| content(line) > 0);
    let parsed = lines.map(|(index, line)| {
        point(line)
            .ok_or_else(|| PointsError::NotAPoint { line: index + 1, text: super::message::plain(line) })
    });
    parsed.collect()
}

fn point(line: &str) -> Option<[f64; 2]> {
    let line = line.split('#').next()?;
    let numbers: Option<Vec<f64>> = line
        .split(|c: char| c.is_whitespace() || c == ',' || c == ';')
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().ok().filter(|value: &f64| value.is_finite()))
        .collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spaces_commas_and_comments() {
        let text = "# x y\n1 2\r\n 3.5,-4e-1 # end\n\n\t5\t6\n";
        assert_eq!(parse(text).unwrap(), [[1.0, 2.0], [3.5, -0.4], [5.0, 6.0]]);
    }

    #[test]
    fn bad_lines_are_named() {
        for bad in ["1", "1 2 3", "x y", "nan 1", "1 inf"] {
            let error = parse(&format!("0 0\n{bad}\n")).unwrap_err().to_string();
            assert!(error.contains("line 2") && error.contains(bad), "{error}");
        }
    }
}
