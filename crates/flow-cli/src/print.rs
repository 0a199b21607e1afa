//! Data goes to standard output, talk to standard error.

use std::io::{self, ErrorKind, Write};

use serde_json::{Value, json};

use crate::error::CliError;

/// Prints data. A reader that has gone (`… | head`) is no error.
pub fn data(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}").and_then(|()| out.flush()).or_else(unless_gone).map_err(CliError::Stdout)
}

/// A failure to print, unless the reader has gone.
pub fn unless_gone(error: io::Error) -> io::Result<()> {
    if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(error) }
}

/// Says something; nobody need listen.
pub fn talk(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// A number for JSON, or the name of what is none: JSON has neither NaN nor infinity.
pub fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { json!(value.to_string()) }
}

/// A count for JSON, of what was computed as a number.
pub fn count(value: f64) -> Value {
    let whole = (0.0..=MOST_COUNTED).contains(&value);
    if whole { json!(value.round() as u64) } else { number(value) }
}

/// Whole numbers up to here are exact.
const MOST_COUNTED: f64 = 9_007_199_254_740_992.0;

/// Seven digits that count, at any size: 5.604831, 1.234568e-6.
pub fn digits(value: f64) -> String {
    significant(value, 7)
}

/// `value` with so many digits that count, without an exponent where it is neither small nor large.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if (-4.0..=6.0).contains(&exponent) {
        let decimals = digits - 1 - exponent as i32;
        // Digits before the point that do not count are zeros.
        let unit = 10_f64.powi(-decimals);
        let rounded = if decimals < 0 { (value / unit).round() * unit } else { value };
        format!("{rounded:.*}", usize::try_from(decimals).unwrap_or(0))
    } else {
        format!("{value:.*e}", usize::try_from(digits - 1).unwrap_or(0))
    }
}

/// `count` things, one of them without its s.
pub fn counted(count: u64, things: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {things}{ending}")
}

/// The text without what a terminal would obey: control characters, and marks that turn the direction of writing.
pub fn harmless(text: &str) -> String {
    let escaped = |character: char| {
        let turns = matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        if character.is_control() || turns {
            character.escape_default().to_string()
        } else {
            character.to_string()
        }
    };
    text.chars().map(escaped).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_digits_count_at_any_size() {
        for (value, text) in [
            (0.0, "0"),
            (5.604_831_2, "5.604831"),
            (0.001_234_567_8, "0.001234568"),
            (-12.5, "-12.50000"),
            (7.9e6, "7900000"),
            (7.9e7, "7.900000e7"),
            (8.123_456_78e-6, "8.123457e-6"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(digits(value), text);
        }
        assert_eq!([129.4, 0.0783, 3.0].map(|value| significant(value, 2)), ["130", "0.078", "3.0"]);
    }

    #[test]
    fn counts_are_whole_numbers_in_json() {
        assert_eq!([0.0, 202.3, 5_081_125.55].map(|value| count(value).to_string()), ["0", "202", "5081126"]);
        assert_eq!(count(f64::NAN), "NaN");
    }

    #[test]
    fn nothing_that_is_printed_commands_the_terminal() {
        assert_eq!(harmless("κ \u{1b}[31m\n\u{202e}"), "κ \\u{1b}[31m\\n\\u{202e}");
    }
}
