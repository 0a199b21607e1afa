//! A parsed expression: its text, its graph, and its slow, obvious evaluation.

use super::derivative::differentiate;
use super::error::ExpressionError;
use super::graph::Node;
use super::parse::parse;
use super::split::split;

/// A function of named variables, written as text or derived from one that was.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    variables: Vec<String>,
    /// Operands before the nodes that use them; the last node is the value.
    nodes: Vec<Node>,
}

impl Expression {
    /// Reads `text` as a function of `variables`; a variable's index is its position in that list.
    /// # Errors
    /// [`ExpressionError`], with the column of the first mistake and what may stand there.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        let nodes = parse(text, variables)?;
        let variables = variables.iter().map(|&name| name.to_owned()).collect();
        Ok(Self { text: text.to_owned(), variables, nodes })
    }

    /// The function that is `value` everywhere.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { text: value.to_string(), variables: Vec::new(), nodes: vec![Node::Constant(value)] }
    }

    /// The same function as one of `variables`, in which its own are found by their names.
    /// # Panics
    /// If a variable that occurs is not among them.
    #[must_use]
    pub fn over(&self, variables: &[&str]) -> Self {
        let position = |name: &String| variables.iter().position(|known| known == name);
        let renumbered = |node: &Node| match node {
            Node::Variable(index) => position(&self.variables[*index]).map(Node::Variable),
            node => Some(*node),
        };
        let nodes = self.nodes.iter().map(renumbered).collect::<Option<Vec<_>>>();
        let nodes = nodes.unwrap_or_else(|| panic!("`{}` is no function of {variables:?}", self.text));
        Self {
            text: self.text.clone(),
            variables: variables.iter().map(|&name| name.to_owned()).collect(),
            nodes,
        }
    }

    /// The exact derivative by the variable at index `variable`, simplified; that of `abs` at 0 is taken as 0.
    ///
    /// Its [`text`](Self::text) is `d(…)/d(name)` around the text of `self`.
    /// # Errors
    /// [`ExpressionError::TooManyTerms`] if the derivative grows beyond bounds.
    /// # Panics
    /// If there is no such variable; a constant is one of any variables.
    pub fn derivative(&self, variable: usize) -> Result<Self, ExpressionError> {
        let name = self.variables.get(variable).map_or("?", String::as_str);
        let known = self.variables.is_empty() || variable < self.variables.len();
        assert!(known, "variable {variable} of `{}`, which has {}", self.text, self.variables.len());
        let nodes = differentiate(&self.nodes, variable)?;
        let text = format!("d({})/d({name})", self.text);
        Ok(Self { text, variables: self.variables.clone(), nodes })
    }

    /// The expression as the sum of a function without the variables from index `first` on, the slopes, and of the rest; none where that
    /// is zero. The first has what stands beside slopes and depends on variables that are `bare`, which have none in the expression.
    ///
    /// Their [`text`](Self::text) is that of `self`.
    /// # Errors
    /// [`ExpressionError::TooManyTerms`] if the parts grow beyond bounds.
    pub fn split_from(
        &self,
        first: usize,
        bare: &dyn Fn(usize) -> bool,
    ) -> Result<[Option<Self>; 2], ExpressionError> {
        let part = |nodes| Self { text: self.text.clone(), variables: self.variables.clone(), nodes };
        Ok(split(&self.nodes, first, bare)?.map(|nodes| nodes.map(part)))
    }

    /// Whether the variable at index `variable` occurs in the expression.
    #[must_use]
    pub fn depends_on(&self, variable: usize) -> bool {
        self.nodes.iter().any(|node| matches!(node, Node::Variable(index) if *index == variable))
    }

    /// How many variables need values: one more than the last that occurs, none for a constant.
    #[must_use]
    pub fn arity(&self) -> usize {
        let needed = |node: &Node| if let Node::Variable(index) = node { index + 1 } else { 0 };
        self.nodes.iter().map(needed).max().unwrap_or(0)
    }

    /// The text the expression was read from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value where the variables have the given `values`: the reference for [`Program`](super::Program).
    /// # Shapes
    /// `values`: one value per variable, in the order given to [`parse`](Self::parse).
    /// # Panics
    /// If there are fewer values than [`arity`](Self::arity).
    #[must_use]
    pub fn evaluate(&self, values: &[f64]) -> f64 {
        let mut results = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            results.push(match *node {
                Node::Constant(value) => value,
                Node::Variable(variable) => values[variable],
                Node::Unary(function, a) => function.apply(results[a]),
                Node::Binary(operator, a, b) => operator.apply(results[a], results[b]),
            });
        }
        results[results.len() - 1]
    }

    /// The graph, operands first, the value last.
    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, x: f64) -> f64 {
        Expression::parse(text, &["x"]).unwrap().evaluate(&[x])
    }

    #[test]
    fn every_function_has_its_value() {
        assert_eq!(at("exp(x) + ln(x) + sqrt(x)", 2.0), 2f64.exp() + 2f64.ln() + 2f64.sqrt());
        assert_eq!(at("sin(x) + cos(x) + tan(x)", 2.0), 2f64.sin() + 2f64.cos() + 2f64.tan());
        assert_eq!(at("sinh(x) + cosh(x) + tanh(x)", 2.0), 2f64.sinh() + 2f64.cosh() + 2f64.tanh());
        assert_eq!(at("abs(-x) * pi", 2.0), 2.0 * std::f64::consts::PI);
    }

    #[test]
    fn text_and_dependence_follow_the_derivative() {
        let expression = Expression::parse("x*y + y", &["x", "y"]).unwrap();
        let slope = expression.derivative(0).unwrap();
        assert_eq!(slope.text(), "d(x*y + y)/d(x)");
        assert!(!slope.depends_on(0) && slope.depends_on(1));
        assert_eq!(Expression::constant(2.5).text(), "2.5");
        assert_eq!(Expression::constant(2.5).derivative(0).unwrap().evaluate(&[]), 0.0);
    }

    #[test]
    fn over_other_variables_a_function_is_the_one_that_its_text_says() {
        let (own, other) = (["x", "y"], ["z", "y", "x"]);
        for text in ["x^2 - 3*y", "exp(y)", "2.5"] {
            let [moved, read] = [
                Expression::parse(text, &own).unwrap().over(&other),
                Expression::parse(text, &other).unwrap(),
            ];
            assert_eq!(format!("{moved:?}"), format!("{read:?}"));
        }
        assert_eq!(Expression::constant(2.5).over(&["x"]).derivative(0).unwrap().evaluate(&[1.0]), 0.0);
    }

    #[test]
    #[should_panic(expected = "`x + y` is no function of [\"x\"]")]
    fn a_function_of_two_variables_is_none_of_one() {
        let _ = Expression::parse("x + y", &["x", "y"]).unwrap().over(&["x"]);
    }

    #[test]
    fn the_arity_is_that_of_the_variables_that_occur() {
        let of = |text| Expression::parse(text, &["x", "y", "z"]).unwrap().arity();
        assert_eq!([of("2.0"), of("x + 1"), of("z*x"), of("y^2")], [0, 1, 3, 2]);
    }

    #[test]
    #[should_panic(expected = "variable 7 of `x + y`, which has 2")]
    fn there_is_no_derivative_by_what_is_no_variable() {
        let _ = Expression::parse("x + y", &["x", "y"]).unwrap().derivative(7);
    }
}
