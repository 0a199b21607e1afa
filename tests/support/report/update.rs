//! Puts tables into a document between marks.

use std::fs;

use super::Table;

/// Ends a table.
pub(super) const END: &str = "<!-- end of table -->";

/// Begins the table `name`.
pub(super) fn begin(name: &str) -> String {
    format!("<!-- table {name} -->")
}

/// Replaces each table of the document at `path`.
pub(super) fn update(path: &str, tables: &[Table]) -> Result<(), String> {
    let mut text = fs::read_to_string(path).map_err(|error| format!("cannot read {path}: {error}"))?;
    for (name, table) in tables {
        text = replaced(&text, name, &table()).ok_or_else(|| format!("{path} has no {}", begin(name)))?;
    }
    fs::write(path, text).map_err(|error| format!("cannot write {path}: {error}"))
}

/// `text` with the table `name` replaced, if it has its marks.
fn replaced(text: &str, name: &str, table: &str) -> Option<String> {
    let begin = begin(name);
    let (before, rest) = text.split_once(&begin)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{begin}\n{table}\n{END}{after}"))
}
