//! What is not finite, in the words of the scene.

use std::fmt::{self, Display, Formatter};

use crate::flow::{NotFinite, TermPart, TermPlace};

/// A value of a term that is not finite, or too large, with the names of the variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    /// The value.
    pub found: NotFinite,
    /// Names of the densities.
    pub densities: Vec<String>,
}

impl Culprit {
    fn variable(&self, index: usize) -> String {
        let fields = self.densities.len() + 1;
        let slope = if index < fields { "" } else { "_sigma" };
        let name = match index % fields {
            0 => "kappa",
            density => &self.densities[density - 1],
        };
        format!("{name}{slope}")
    }

    fn part(&self) -> String {
        match self.found.part {
            TermPart::Value => "value".to_owned(),
            TermPart::First(a) => format!("first derivative by `{}`", self.variable(a)),
            TermPart::Second(a, b) if a == b => format!("second derivative by `{}`", self.variable(a)),
            TermPart::Second(a, b) => {
                format!("second derivative by `{}` and `{}`", self.variable(b), self.variable(a))
            }
            TermPart::OfLength(0) => "function of the length".to_owned(),
            TermPart::OfLength(1) => "first derivative by the length".to_owned(),
            TermPart::OfLength(_) => "second derivative by the length".to_owned(),
            TermPart::Force => "force".to_owned(),
        }
    }
}

/// "its first derivative by `a` is inf at node 3, where kappa = 1.000000, a = 0".
impl Display for Culprit {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        write!(out, "its {} is {}", self.part(), number(self.found.value))?;
        if self.found.value.is_finite() {
            write!(out, ", too large to be squared,")?;
        }
        match self.found.place {
            TermPlace::Node(node) => write!(out, " at node {node}")?,
            TermPlace::After(node) => write!(out, " between node {node} and the next one")?,
            TermPlace::Curve => {}
        }
        for (index, value) in self.found.variables.iter().enumerate() {
            let separator = if index == 0 { ", where " } else { ", " };
            write!(out, "{separator}{} = {}", self.variable(index), number(*value))?;
        }
        Ok(())
    }
}

/// Six digits, with an exponent where zeros would hide them.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e5 => format!("{value:.6}"),
        _ if value.is_finite() => format!("{value:.6e}"),
        _ => value.to_string(),
    }
}
