//! The summary as a table for people.

use std::fmt::Write;

use serde_json::Value;

use crate::print::harmless;

/// What most runs have none of: shown only where there is some.
const RARE: [&str; 3] = ["remaps", "remap_error", "unresolved_steps"];

/// A line for each value, and for each entry of a list.
pub fn table(rows: &[(String, Value)]) -> String {
    let width = rows.iter().map(|(key, _)| key.chars().count()).max().unwrap_or(0);
    let mut table = String::new();
    for (key, value) in rows.iter().filter(|(key, value)| is_shown(key, value)) {
        let entries = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
        for (number, entry) in entries.iter().enumerate() {
            let text = entry.as_str().map_or_else(|| entry.to_string(), harmless);
            let name = if number == 0 { key } else { "" };
            let _ = writeln!(table, "{name:width$}  {text}"); // a String never fails
        }
    }
    table.truncate(table.trim_end().len());
    table
}

fn is_shown(key: &str, value: &Value) -> bool {
    let is_none = value.is_null() || (RARE.contains(&key) && value.as_f64() == Some(0.0));
    !is_none
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn lists_have_a_line_for_each_entry_and_what_there_is_not_has_none() {
        let rows = [
            ("events", json!(["0 → 2 crossings", "2 → 0 crossings"])),
            ("warnings", json!([])),
            ("time", Value::Null),
            ("remap_error", json!(0.0)),
            ("steps", json!(0)),
        ];
        let rows = rows.map(|(key, value)| (key.to_owned(), value));
        assert_eq!(
            table(&rows),
            "events       0 → 2 crossings\n             2 → 0 crossings\nsteps        0"
        );
    }
}
