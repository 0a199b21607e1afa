//! What can be wrong with a scene, as data; the wording is in `message.rs`.

use std::io;
use std::path::PathBuf;

use super::points::PointsError;
use crate::expression::ExpressionError;

/// Why a scene could not be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum SceneError {
    /// The file could not be opened or read.
    #[error("{}", super::message::unreadable(path))]
    Unreadable { path: PathBuf, source: io::Error },
    /// The file is too large to be a scene.
    #[error(
        "`{source_name}` is larger than {limit} bytes, the limit for a scene; put long lists of points in a file \
         and name it under [curve] file"
    )]
    TooLarge { source_name: String, limit: usize },
    /// The file is not UTF-8 text.
    #[error("`{source_name}` is not text: byte {offset} is not UTF-8; a scene is a TOML file saved as UTF-8")]
    NotText { source_name: String, offset: usize },
    /// The text is not TOML.
    #[error("{}", super::message::syntax(source_name, place, *column, message))]
    Syntax { source_name: String, place: Place, column: usize, message: String },
    /// The text is TOML, but not a scene; holds all problems, in the order of their lines.
    #[error("{}", super::message::invalid(source_name, problems))]
    Invalid { source_name: String, problems: Vec<Problem> },
}

impl SceneError {
    /// The problems found, if the text was TOML at all.
    #[must_use]
    pub fn problems(&self) -> &[Problem] {
        match self {
            Self::Invalid { problems, .. } => problems,
            _ => &[],
        }
    }

    /// The same problems at their keys instead of lines: for a scene whose text a program wrote and nobody reads.
    #[must_use]
    pub fn at_keys(mut self) -> Self {
        if let Self::Invalid { problems, .. } = &mut self {
            for problem in problems {
                problem.place = Place::Key(problem.key.clone());
            }
        }
        self
    }
}

/// One thing that is wrong with a scene.
#[derive(Debug)]
pub struct Problem {
    /// Dotted path of the key, as for `--set`: `accuracy.tolerance`, `density.0.initial`.
    pub key: String,
    /// Where it is written.
    pub place: Place,
    /// What is wrong.
    pub fault: Fault,
}

impl Problem {
    /// Line in the scene file, counted from 1, if the problem is in the file.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self.place {
            Place::Line { number, .. } => Some(number),
            _ => None,
        }
    }
}

/// Where in a scene something is written.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[allow(missing_docs)] // the variants name their fields
pub enum Place {
    /// A line of the file, counted from 1.
    Line { number: usize, text: String },
    /// A `--set key=value` of the command line.
    Override { key: String, value: String },
    /// The value of a key in a program.
    Key(String),
    /// Nowhere: the whole table is missing.
    Nowhere,
}

/// What is wrong at one key.
#[derive(Debug)]
#[non_exhaustive]
#[allow(missing_docs)] // the variants name their fields
pub enum Fault {
    /// The table has no such key.
    UnknownKey { suggestion: Option<&'static str>, allowed: Vec<&'static str> },
    /// The key must be there; the example can be copied.
    MissingKey { example: &'static str },
    /// A value of another type.
    WrongType { expected: &'static str, found: String, remedy: &'static str },
    /// A number outside its range, or not finite.
    OutOfRange { value: f64, written: String, bound: Bound, remedy: &'static str },
    /// A list with too few or too many entries.
    WrongCount { count: usize, bound: Bound, remedy: &'static str },
    /// Not one of the names allowed.
    UnknownName { value: String, suggestion: Option<String>, allowed: Vec<&'static str> },
    /// A text with a NUL character, which no result file can hold.
    HoldsNul,
    /// A formula that is not in the grammar.
    Expression { text: String, source: ExpressionError },
    /// Keys that exclude each other.
    Conflict { with: &'static str, remedy: &'static str },
    /// A key that has no meaning with the choice made at another one.
    OtherChoice { choice: &'static str, value: &'static str, remedy: &'static str },
    /// A formula with a value outside its range.
    ValueOutOfRange {
        text: String,
        variable: &'static str,
        at: f64,
        value: f64,
        bound: Bound,
        remedy: &'static str,
    },
    /// A density that the scene does not have.
    UnknownDensity { value: String, suggestion: Option<String>, densities: Vec<String> },
    /// A term that needs a density in a scene without any.
    NoDensity { needs: &'static str },
    /// A matrix whose entries differ from those across the diagonal.
    NotSymmetric { indices: [usize; 2], value: f64, other: f64 },
    /// A symmetric matrix whose lowest eigenvalue is not above zero.
    NotPositiveDefinite { lowest: f64 },
    /// Two densities of the same name.
    DuplicateDensity { value: String, first: usize },
    /// A density named like a variable, constant or function of expressions.
    ReservedName { value: String },
    /// A density name that cannot be written in an expression.
    NotAnIdentifier { value: String },
    /// A list of times that does not increase.
    NotIncreasing { value: f64, previous: f64 },
    /// Neighbouring points that coincide.
    RepeatedPoint { index: usize, value: [f64; 2] },
    /// A file of points that could not be used.
    Points { file: PathBuf, source: PointsError },
    /// A `--set` key that leads nowhere.
    NoSuchPlace { reason: String, remedy: &'static str },
}

/// The range of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Bound {
    /// Any finite number.
    Finite,
    /// Greater than zero.
    Positive,
    /// Greater than zero and not greater than this.
    PositiveUpTo(f64),
    /// This or greater.
    AtLeast(f64),
    /// Between these two, both allowed.
    Between(f64, f64),
    /// This value and no other.
    Exactly(f64),
}

impl Bound {
    /// Whether a finite number is in the range; NaN and infinities never are.
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => value > 0.0,
                Self::PositiveUpTo(maximum) => value > 0.0 && value <= maximum,
                Self::AtLeast(minimum) => value >= minimum,
                Self::Between(minimum, maximum) => (minimum..=maximum).contains(&value),
                Self::Exactly(only) => value == only,
            }
    }
}
