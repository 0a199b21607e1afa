//! One value of a scene while it is read: each method asks for a type, and reports what it found instead.

use std::ops::Range;
use std::path::Path;

use toml::de::DeValue;

use super::choice::Choice;
use super::error::{Bound, Fault};
use super::formula::Formula;
use super::message::plain;
use super::report::Report;
use super::section::Section;
use super::suggest::nearest;

/// Points at which a formula that must be positive is looked at.
const SAMPLES: usize = 512;

/// A value with its place. Methods that return `None` have reported why.
pub(super) struct Entry<'d> {
    report: &'d Report<'d>,
    path: String,
    span: Range<usize>,
    value: &'d DeValue<'d>,
}

impl<'d> Entry<'d> {
    pub(super) fn new(
        report: &'d Report<'d>,
        path: String,
        span: Range<usize>,
        value: &'d DeValue<'d>,
    ) -> Self {
        Self { report, path, span, value }
    }

    /// Reports a problem with this value.
    pub(super) fn fault(&self, fault: Fault) {
        self.report.add(&self.path, &self.span, fault);
    }

    /// Folder that paths in the scene start from.
    pub(super) fn folder(&self) -> &'d Path {
        self.report.folder()
    }

    /// A number in a range; integers count.
    pub(super) fn number(&self, bound: Bound, remedy: &'static str) -> Option<f64> {
        let Some((value, written)) = self.as_number() else {
            return self.wrong_type("a number");
        };
        let vanished = value == 0.0 && mantissa_is_not_zero(&written);
        if vanished || !bound.contains(value) {
            self.fault(Fault::OutOfRange { value, written, bound, remedy });
            return None;
        }
        Some(value)
    }

    /// An integer in a range that 64-bit floats hold exactly.
    pub(super) fn integer(&self, bound: Bound, remedy: &'static str) -> Option<i64> {
        self.integer_or("an integer", bound, remedy)
    }

    /// An integer where `expected` says what else could stand.
    pub(super) fn integer_or(
        &self,
        expected: &'static str,
        bound: Bound,
        remedy: &'static str,
    ) -> Option<i64> {
        let DeValue::Integer(_) = self.value else {
            return self.wrong_type(expected);
        };
        self.number(bound, remedy).map(|value| value as i64)
    }

    /// Whether the value is this text.
    pub(super) fn is(&self, text: &str) -> bool {
        self.value.as_str() == Some(text)
    }

    pub(super) fn is_list(&self) -> bool {
        self.value.is_array()
    }

    pub(super) fn boolean(&self) -> Option<bool> {
        self.value.as_bool().or_else(|| self.wrong_type("true or false"))
    }

    pub(super) fn text(&self) -> Option<&'d str> {
        self.value.as_str().or_else(|| self.wrong_type("text in quotes"))
    }

    /// A text that goes into result files as it is.
    pub(super) fn stored_text(&self) -> Option<&'d str> {
        let text = self.text()?;
        if text.contains('\0') {
            self.fault(Fault::HoldsNul);
            return None;
        }
        Some(text)
    }

    /// One of the names of `T`.
    pub(super) fn choice<T: Choice>(&self) -> Option<T> {
        let text = self.text()?;
        if let Some(&choice) = T::ALL.iter().find(|choice| choice.name() == text) {
            return Some(choice);
        }
        let allowed: Vec<&'static str> = T::ALL.iter().map(|choice| choice.name()).collect();
        self.not_a_choice(text, allowed);
        None
    }

    /// Reports a name that is unknown.
    pub(super) fn not_a_choice(&self, text: &str, allowed: Vec<&'static str>) {
        let suggestion = nearest(text, allowed.iter().copied()).map(str::to_owned);
        self.fault(Fault::UnknownName { value: text.to_owned(), suggestion, allowed });
    }

    /// A number, or an expression of the variables.
    pub(super) fn formula(&self, variables: &[&str]) -> Option<Formula> {
        self.formula_or("a number or an expression in quotes", variables)
    }

    /// The same where `expected` says what else could stand.
    pub(super) fn formula_or(&self, expected: &'static str, variables: &[&str]) -> Option<Formula> {
        let Some(text) = self.value.as_str() else {
            if self.as_number().is_none() {
                return self.wrong_type(expected);
            }
            let number = self.number(Bound::Finite, "write an ordinary number")?;
            return Some(Formula::constant(number, variables));
        };
        match Formula::parse(text, variables) {
            Ok(formula) => Some(formula),
            Err(source) => {
                self.fault(Fault::Expression { text: text.to_owned(), source });
                None
            }
        }
    }

    /// A number or an expression of a variable in [0, 1) that is positive wherever it is looked at here; the nodes are checked
    /// once they are known.
    pub(super) fn positive_formula(&self, variable: &'static str, remedy: &'static str) -> Option<Formula> {
        let formula = self.formula(&[variable])?;
        let points: Vec<f64> = (0..SAMPLES).map(|i| i as f64 / SAMPLES as f64).collect();
        let values = formula.values(&points);
        let wrong = values.iter().position(|value| !Bound::Positive.contains(*value));
        let Some(at) = wrong else { return Some(formula) };
        let (text, at, value) = (formula.text(), points[at], values[at]);
        self.fault(Fault::ValueOutOfRange { text, variable, at, value, bound: Bound::Positive, remedy });
        None
    }

    pub(super) fn section(self) -> Option<Section<'d>> {
        let DeValue::Table(table) = self.value else {
            return self.wrong_type("a table");
        };
        Some(Section::new(self.report, self.path, self.span, table))
    }

    /// The entries of a list; a problem on one of them names its index and its line.
    pub(super) fn list(&self, of: &'static str) -> Option<Vec<Entry<'d>>> {
        let DeValue::Array(array) = self.value else {
            return self.wrong_type(of);
        };
        let entry = |(index, value): (usize, &'d toml::Spanned<DeValue<'d>>)| {
            Entry::new(self.report, format!("{}.{index}", self.path), value.span(), value.get_ref())
        };
        Some(array.iter().enumerate().map(entry).collect())
    }

    /// A list of exactly two numbers.
    pub(super) fn pair(&self, bound: Bound, remedy: &'static str) -> Option<[f64; 2]> {
        let list = self.list("a list of two numbers")?;
        let [first, second] = list.as_slice() else {
            self.fault(Fault::WrongCount { count: list.len(), bound: Bound::Exactly(2.0), remedy });
            return None;
        };
        let (first, second) = (first.number(bound, remedy), second.number(bound, remedy));
        Some([first?, second?])
    }

    fn wrong_type<T>(&self, expected: &'static str) -> Option<T> {
        let is_number = |text: &str| text.trim().parse::<f64>().is_ok();
        let is_boolean = |text: &str| matches!(text, "true" | "false");
        let remedy = match (self.value, expected) {
            (DeValue::String(text), "a number") if is_number(text) => "remove the quotes",
            (DeValue::String(text), of) if of.starts_with("an integer") && is_number(text) => {
                "remove the quotes"
            }
            (DeValue::String(text), "true or false") if is_boolean(text) => "remove the quotes",
            (DeValue::Float(_), of) if of.starts_with("an integer") => {
                "write it without a decimal point or exponent"
            }
            (DeValue::Integer(_) | DeValue::Float(_), "text in quotes") => "put it in quotes",
            (_, "a table") => "write its keys below a line with the name in [brackets]",
            (_, "a list of tables") => {
                "write the name in double brackets, as [[density]] and [[flow.switch]]"
            }
            (_, "true or false") => "write the word without quotes",
            (_, of) if of.starts_with("a list") => {
                "write the entries in [brackets], with commas between them"
            }
            (_, of) if of.starts_with("an integer") => "write, for example, 100",
            (_, of) if of.starts_with("a number") => "write, for example, 1.0",
            _ => "write it like \"this\"",
        };
        self.fault(Fault::WrongType { expected, found: found(self.value), remedy });
        None
    }

    /// The number and how it was written.
    fn as_number(&self) -> Option<(f64, String)> {
        match self.value {
            DeValue::Float(float) => {
                Some((float.as_str().parse().unwrap_or(f64::NAN), float.as_str().to_owned()))
            }
            // Integers beyond 64 bits are out of every range here.
            DeValue::Integer(integer) => {
                let value = i64::from_str_radix(integer.as_str(), integer.radix())
                    .map_or(f64::INFINITY, |v| v as f64);
                Some((value, integer.to_string()))
            }
            _ => None,
        }
    }
}

/// Whether a number is written with a digit other than zero before its exponent.
fn mantissa_is_not_zero(written: &str) -> bool {
    let decimal = !written.starts_with("0x") && !written.starts_with("0b") && !written.starts_with("0o");
    decimal && written.chars().take_while(|c| !matches!(c, 'e' | 'E')).any(|c| ('1'..='9').contains(&c))
}

fn found(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the text \"{}\"", plain(text)),
        DeValue::Integer(integer) => format!("the integer {}", plain(&integer.to_string())),
        DeValue::Float(float) => format!("the number {}", plain(float.as_str())),
        DeValue::Boolean(boolean) => format!("{boolean}"),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(array) => format!("a list of {} entries", array.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}
