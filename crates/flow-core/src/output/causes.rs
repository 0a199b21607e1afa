//! An error as a person reads it.

use std::error::Error;

/// `error` and everything that caused it, one line each.
#[must_use]
pub fn with_causes(error: &dyn Error) -> String {
    let (mut text, mut cause) = (error.to_string(), error.source());
    while let Some(inner) = cause {
        text = format!("{text}\n  caused by: {inner}");
        cause = inner.source();
    }
    text
}
