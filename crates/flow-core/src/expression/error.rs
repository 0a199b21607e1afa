//! What is wrong with the text of an expression, where, and what to write instead.

use std::fmt;

use super::spelling::ours;

/// Why an expression could not be read or differentiated.
///
/// A `column` counts characters of the text from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum ExpressionError {
    /// The text exceeds the limit.
    #[error("the expression is {length} bytes long, the limit is {limit}: split it into simpler terms")]
    TooLong { length: usize, limit: usize },
    /// Parentheses, functions, minus signs or powers are nested too deeply.
    #[error("column {column}: nested more than {limit} levels deep; remove redundant parentheses")]
    TooDeep { column: usize, limit: usize },
    /// The expression, or its derivative, has too many distinct terms.
    #[error("the expression or its derivative needs more than {limit} distinct terms; simplify it")]
    TooManyTerms { limit: usize },
    /// A character that no expression contains.
    #[error(
        "column {column}: found the character {found:?}; an expression has only numbers, names, + - * / ^ and parentheses"
    )]
    UnexpectedCharacter { column: usize, found: char },
    /// A piece of text in a place where something else must stand.
    #[error("column {column}: found `{found}`, expected {expected}")]
    UnexpectedToken { column: usize, found: String, expected: &'static str },
    /// The text stops too early.
    #[error("column {column}: the expression ends here, expected {expected}")]
    UnexpectedEnd { column: usize, expected: &'static str },
    /// A number that a 64-bit float cannot hold.
    #[error("column {column}: the number `{literal}` is outside the range 1e-308 to 1e308; rescale it")]
    NumberOutOfRange { column: usize, literal: String },
    /// A power as other languages write it.
    #[error("column {column}: a power is written `^`, as in `kappa^2`, not `**`")]
    DoubleStar { column: usize },
    /// A name that is neither a variable nor a function.
    #[error("column {column}: unknown name `{name}`{}; allowed: {}", DidYouMean(suggestion.as_deref()), allowed.join(", "))]
    UnknownName { name: String, column: usize, suggestion: Option<String>, allowed: Vec<String> },
    /// A variable that carries the name of a function or of `pi`.
    #[error("the variable `{name}` is named like a built-in function or constant; rename the variable")]
    ReservedVariable { name: String },
}

/// Prints `, did you mean …?`, or nothing.
struct DidYouMean<'a>(Option<&'a str>);

impl fmt::Display for DidYouMean<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |name| write!(f, " (did you mean `{name}`?)"))
    }
}

/// Variables of expressions elsewhere in a scene: whoever writes one meant it.
const VARIABLES: [&str; 5] = ["s", "phi", "q", "kappa", "rho"];

/// The error for `name`, with the nearest allowed name if one is close.
#[cold]
pub(super) fn unknown_name(name: &str, column: usize, allowed: &[&str]) -> ExpressionError {
    let suggestion = match ours(name, allowed) {
        None if VARIABLES.contains(&name) => None,
        None => nearest(name, allowed).map(str::to_owned),
        ours => ours,
    };
    let allowed = allowed.iter().map(|&name| name.to_owned()).collect();
    ExpressionError::UnknownName { name: name.to_owned(), column, suggestion, allowed }
}

fn nearest<'a>(name: &str, allowed: &[&'a str]) -> Option<&'a str> {
    let (distance, near) =
        allowed.iter().map(|candidate| (edit_distance(name, candidate), *candidate)).min()?;
    let tolerated = if name.chars().count() <= 3 { 1 } else { 2 };
    (distance <= tolerated).then_some(near)
}

/// Number of inserted, removed or replaced characters between two names, letter case ignored.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.to_lowercase(), b.to_lowercase());
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..b.len() {
            let replaced = diagonal + usize::from(letter != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_counts_single_letter_changes() {
        assert_eq!(edit_distance("kapa", "kappa"), 1);
        assert_eq!(edit_distance("Kappa", "kappa"), 0);
        assert_eq!(edit_distance("", "rho"), 3);
        assert_eq!(edit_distance("sinh", "cosh"), 3);
    }

    #[test]
    fn unknown_name_lists_what_is_allowed() {
        let message = unknown_name("kapa", 3, &["kappa", "exp"]).to_string();
        assert_eq!(message, "column 3: unknown name `kapa` (did you mean `kappa`?); allowed: kappa, exp");
        let suggestion = |name, allowed: &[&str]| match unknown_name(name, 1, allowed) {
            ExpressionError::UnknownName { suggestion, .. } => suggestion,
            _ => None,
        };
        assert_eq!(suggestion("log", &["ln", "cos"]).as_deref(), Some("ln"));
        assert_eq!(suggestion("κ", &["rho"]), None);
        assert_eq!(suggestion("phi", &["s", "pi"]), None);
        let message = unknown_name("velocity", 1, &["kappa"]).to_string();
        assert_eq!(message, "column 1: unknown name `velocity`; allowed: kappa");
    }
}
