//! Digits that tell nothing.

/// A number without the zeros at the end of its decimals.
pub fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}
