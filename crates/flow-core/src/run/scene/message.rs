//! The wording of scene errors: what, where, the value, the bound, one thing to try.

use std::fmt::{self, Display, Formatter};
use std::path::Path;

use super::error::{Bound, Fault, Place, Problem};
use super::shipped;

/// More problems than this are counted, not shown.
const MAX_SHOWN: usize = 20;
/// What is wrong with a line such as `end =`.
pub(super) const NO_VALUE: &str = "no value after `=`";
/// Longer values and lines are cut.
const MAX_CHARACTERS: usize = 100;

/// Text as it can be shown on a terminal: one line, no control characters, no blanks around it, not too long.
pub(super) fn plain(text: &str) -> String {
    verbatim(text.trim())
}

/// [`plain`] with the blanks around it: those of a key are a part of what is wrong with it.
fn verbatim(text: &str) -> String {
    let mut out = String::new();
    for (count, c) in text.chars().enumerate() {
        if count == MAX_CHARACTERS {
            out.push('…');
            break;
        }
        match c {
            '\t' => out.push(' '),
            c if c.is_control() => out.extend(c.escape_default()),
            c => out.push(c),
        }
    }
    out
}

#[cold]
pub(super) fn unreadable(path: &Path) -> String {
    let name = plain(&path.display().to_string());
    let meant = shipped::like(&name).map(|shipped| format!("did you mean the shipped scene `{shipped}`? "));
    let meant = meant.unwrap_or_default();
    format!(
        "cannot read the scene `{name}`; {meant}check the path, or list the shipped scenes with `curveflow scenes`"
    )
}

#[cold]
pub(super) fn syntax(source_name: &str, place: &Place, column: usize, message: &str) -> String {
    let hint = match message {
        m if m.contains("duplicate key") => "each key and each [table] may be written only once",
        NO_VALUE => "write one, or remove the line",
        m if m.contains("quoted") => "text values need quotes: shape = \"circle\"",
        m if m.contains("recursion") => "a scene has at most three levels of tables",
        _ => "a line reads `key = value`; text values need quotes, tables are written [name]",
    };
    let message = message.trim_end().replace('\n', ", ");
    format!("{source_name}, {place}\n  not valid TOML at column {column}: {message}; {hint}")
}

#[cold]
pub(super) fn invalid(source_name: &str, problems: &[Problem]) -> String {
    let mut lines = Vec::new();
    if problems.len() > 1 {
        lines.push(format!("{} problems in {source_name}:", problems.len()));
    }
    lines.extend(problems.iter().take(MAX_SHOWN).map(|problem| format!("{source_name}, {problem}")));
    if problems.len() > MAX_SHOWN {
        lines.push(format!("… and {} more", problems.len() - MAX_SHOWN));
    }
    lines.join("\n")
}

impl Display for Place {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { number, text } => write!(out, "line {number} | {text}"),
            Self::Override { key, value } => write!(out, "--set {}={}", verbatim(key), plain(value)),
            Self::Key(key) => write!(out, "{}", plain(key)),
            Self::Nowhere => write!(out, "whole file"),
        }
    }
}

impl Display for Problem {
    #[cold]
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        write!(out, "{}\n  {}", self.place, sentence(&verbatim(&self.key), &self.fault))
    }
}

impl Display for Bound {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Finite => write!(out, "finite"),
            Self::Positive => write!(out, "greater than 0"),
            Self::PositiveUpTo(maximum) => write!(out, "greater than 0 and at most {}", Short(maximum)),
            Self::AtLeast(minimum) => write!(out, "at least {}", Short(minimum)),
            Self::Between(minimum, maximum) => {
                write!(out, "between {} and {}", Short(minimum), Short(maximum))
            }
            Self::Exactly(only) => write!(out, "{}", Short(only)),
        }
    }
}

/// A number without long rows of zeros.
struct Short(f64);

impl Display for Short {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            0.0 | 1e-3..1e6 => write!(out, "{}", self.0),
            _ => write!(out, "{:e}", self.0),
        }
    }
}

fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    quoted.join(", ")
}

/// The suggestion, if there is one, and all that could be meant.
fn instead(suggestion: Option<&str>, what: &str, names: &[impl AsRef<str>]) -> String {
    let names = listed(names);
    suggestion
        .map_or_else(|| format!("{what} {names}"), |name| format!("did you mean `{name}`? ({what} {names})"))
}

fn sentence(key: &str, fault: &Fault) -> String {
    match fault {
        Fault::UnknownKey { suggestion, allowed } => {
            format!("unknown key `{key}`: {}", instead(*suggestion, "the keys here are", allowed))
        }
        Fault::MissingKey { example } => format!("`{key}` is missing: add, for example, {example}"),
        Fault::WrongType { expected, found, remedy } => {
            format!("`{key}` must be {expected}, found {found}; {remedy}")
        }
        Fault::OutOfRange { written, value, bound, remedy } => {
            out_of_range(key, &plain(written), *value, *bound, remedy)
        }
        Fault::WrongCount { count, bound, remedy } => {
            format!("the number of entries of `{key}` is {count}, but it must be {bound}; {remedy}")
        }
        Fault::UnknownName { value, suggestion, allowed } => {
            let instead = instead(suggestion.as_deref(), "allowed are", allowed);
            format!("`{key}` cannot be \"{}\": {instead}", plain(value))
        }
        Fault::Expression { text, source } => format!("`{key}` = \"{}\": {source}", plain(text)),
        Fault::Conflict { with, remedy } => format!("`{key}` and `{with}` exclude each other; {remedy}"),
        Fault::OtherChoice { choice, value, remedy } => {
            format!("`{key}` does not go with `{choice}` = \"{value}\"; {remedy}")
        }
        Fault::ValueOutOfRange { text, variable, at, value, bound, remedy } => {
            let text = plain(text);
            format!(
                "`{key}` = \"{text}\" is {value:.6} at {variable} = {at:.6}: it must be {bound}; {remedy}"
            )
        }
        Fault::UnknownDensity { value, suggestion, densities } => {
            unknown_density(key, &plain(value), suggestion.as_deref(), densities)
        }
        Fault::NoDensity { needs } => {
            format!("`{key}` {needs}, but the scene has no density; add a [[density]] table, or drop the key")
        }
        Fault::NotSymmetric { indices: [i, j], value, other } => format!(
            "`{key}`: entry {j} (from 0) is {value}, but entry {i} of row {j} is {other}; the matrix must be \
             symmetric, write the same number in both places"
        ),
        Fault::NotPositiveDefinite { lowest } => format!(
            "`{key}` is not positive definite: its lowest eigenvalue is {lowest:.6}, it must be greater than 0; \
             make the diagonal larger, or the other entries smaller"
        ),
        Fault::DuplicateDensity { value, first } => format!(
            "`{key}` = \"{value}\" is already the name of density.{first}; give each density a name of its own"
        ),
        Fault::ReservedName { value } => format!(
            "`{key}` cannot be \"{value}\": the name means something else in expressions; \
             choose another, for example \"protein\""
        ),
        Fault::NotAnIdentifier { value } => format!(
            "`{key}` cannot be \"{}\": expressions could not use it; start with a letter, go on with letters, \
             digits and `_`, at most 64 characters, not ending in `_sigma`; for example \"protein_2\"",
            plain(value)
        ),
        Fault::NotIncreasing { value, previous } => {
            format!(
                "`{key}` must increase: {value} follows {previous}; sort the times and remove repeated ones"
            )
        }
        Fault::RepeatedPoint { index, value: [x, y] } => format!(
            "`{key}`: points {index} and {} (from 0) are both [{x}, {y}]; remove one of them",
            index + 1
        ),
        Fault::Points { file, source } => {
            format!("`{key}`: cannot use `{}`: {source}", plain(&file.display().to_string()))
        }
        Fault::HoldsNul => {
            format!("`{key}` holds a NUL character (\\u0000), which a result file cannot hold; leave it out")
        }
        Fault::NoSuchPlace { reason, remedy } => format!("`{key}` cannot be set: {reason}; {remedy}"),
    }
}

fn out_of_range(key: &str, written: &str, value: f64, bound: Bound, remedy: &str) -> String {
    let what = if value.is_finite() && !bound.contains(value) {
        "is out of range: it must be"
    } else if value == 0.0 {
        "is too small for a 64-bit number and would become 0: it must be"
    } else if written.contains(|c: char| c.is_ascii_digit()) {
        "is too large for a 64-bit number: it must be"
    } else if bound == Bound::Finite {
        "is not a finite number: it must be"
    } else {
        "is not a finite number: it must be finite and"
    };
    format!("`{key}` = {written} {what} {bound}; {remedy}")
}

fn unknown_density(key: &str, value: &str, suggestion: Option<&str>, densities: &[String]) -> String {
    let unknown = format!("`{key}` names the density \"{value}\", which the scene does not have");
    if densities.is_empty() {
        return format!("{unknown}; add a [[density]] table with name = \"{value}\"");
    }
    format!("{unknown}: {}", instead(suggestion, "its densities are", densities))
}
