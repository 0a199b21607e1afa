//! Data goes to standard output, talk to standard error.

use std::io::{self, ErrorKind, Write};

use serde_json::{Value, json};

use crate::error::CliError;

/// Prints data. A reader that has gone (`… | head`) is no error.
pub fn data(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => done.map_err(CliError::Stdout),
    }
}

/// Says something; nobody need listen.
pub fn talk(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// A number for JSON, or the name of what is none: JSON has neither NaN nor infinity.
pub fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { json!(value.to_string()) }
}
