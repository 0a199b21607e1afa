//! Expressions in scenes, with the text that they come from.

use schemars::json_schema;
use serde::{Serialize, Serializer};

use super::keywords::inline_schema;
use crate::expression::{Expression, ExpressionError, Program};

/// A number or an expression of a scene, with its text, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Formula {
    expression: Expression,
    variables: Vec<String>,
    written: Written,
}

#[derive(Clone, Debug, PartialEq)]
enum Written {
    Number(f64),
    Text(String),
}

impl Formula {
    /// A formula in `variables`.
    /// # Errors
    /// [`ExpressionError`] if the text is not in the grammar or uses another variable.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        let expression = Expression::parse(text, variables)?;
        Ok(Self { expression, variables: owned(variables), written: Written::Text(text.to_owned()) })
    }

    /// The same value for all values of `variables`.
    #[must_use]
    pub fn constant(value: f64, variables: &[&str]) -> Self {
        let expression = Expression::constant(value);
        Self { expression, variables: owned(variables), written: Written::Number(value) }
    }

    /// The expression; its variables are numbered as in [`Formula::variables`].
    #[must_use]
    pub fn expression(&self) -> &Expression {
        &self.expression
    }

    /// Values of a formula of one variable at `points`.
    ///
    /// # Panics
    /// If it depends on a second variable.
    #[must_use]
    pub fn values(&self, points: &[f64]) -> Vec<f64> {
        assert!(self.expression.arity() <= 1, "`{}` is no formula of one variable", self.text());
        let program = Program::compile(&[&self.expression]);
        let (mut values, mut scratch) = (vec![0.0; points.len()], vec![0.0; program.scratch_len()]);
        program.evaluate(&[points], &mut [&mut values], &mut scratch);
        values
    }

    /// Names of the variables that the formula may use, in the order in which they are passed to the expression.
    #[must_use]
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// The formula as text.
    #[must_use]
    pub fn text(&self) -> String {
        match &self.written {
            Written::Number(value) => value.to_string(),
            Written::Text(text) => text.clone(),
        }
    }
}

fn owned(variables: &[&str]) -> Vec<String> {
    variables.iter().map(|&name| name.to_owned()).collect()
}

inline_schema!(Formula, json_schema!({ "type": ["number", "string"] }));

/// Two formulas are equal if they are written alike, in the same variables.
impl PartialEq for Formula {
    fn eq(&self, other: &Self) -> bool {
        self.written == other.written && self.variables == other.variables
    }
}

impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.written {
            Written::Number(value) => serializer.serialize_f64(*value),
            Written::Text(text) => serializer.serialize_str(text),
        }
    }
}
