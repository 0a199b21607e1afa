//! An expression as what it is without some of its variables, and what these add.

use super::error::ExpressionError;
use super::graph::{Function, Graph, Node, NodeId, Operator};

/// The two parts of a subexpression; none stands for zero.
#[derive(Clone, Copy)]
struct Parts {
    without: Option<NodeId>,
    added: Option<NodeId>,
}

/// The last of `nodes` as the sum of a function without the variables from `first` on and of what these add; none where that is zero.
///
/// The first part is the value where they are zero, as far as sums, products, whole powers and smooth functions go. What is inside of
/// others is in the second part as it stands, unless it is a number at zero: it could have a pole or a corner there.
pub(super) fn split(nodes: &[Node], first: usize) -> Result<[Option<Vec<Node>>; 2], ExpressionError> {
    let mut rules = Rules { graph: Graph::from_nodes(nodes) };
    let mut parts: Vec<Parts> = Vec::with_capacity(nodes.len());
    for (id, node) in nodes.iter().enumerate() {
        let whole = Parts { without: None, added: Some(id) };
        parts.push(match *node {
            Node::Variable(variable) if variable >= first => whole,
            Node::Constant(_) | Node::Variable(_) => Parts { without: Some(id), added: None },
            Node::Unary(function, a) => rules.unary(function, parts[a], id)?,
            Node::Binary(operator, a, b) => rules.binary(operator, (parts[a], parts[b]), b, id)?,
        });
    }
    let part = |id: NodeId| rules.graph.reachable(id);
    let root = parts.last().map_or([None; 2], |root| [root.without, root.added]);
    Ok(root.map(|id| id.map(part)))
}

/// Whether all derivatives exist everywhere, so that a new argument makes no corner and no pole.
fn is_smooth(function: Function) -> bool {
    use Function::{Cos, Cosh, Exp, Sin, Sinh, Tanh};
    matches!(function, Exp | Sin | Cos | Sinh | Cosh | Tanh)
}

struct Rules {
    graph: Graph,
}

impl Rules {
    fn unary(&mut self, function: Function, a: Parts, id: NodeId) -> Result<Parts, ExpressionError> {
        if a.added.is_none() {
            return Ok(Parts { without: Some(id), added: None });
        }
        if function == Function::Negate {
            return Ok(Parts { without: self.negated(a.without)?, added: self.negated(a.added)? });
        }
        let argument = self.or_zero(a.without)?;
        let serves = is_smooth(function) || self.graph.constant_value(argument).is_some();
        let without = serves.then(|| self.graph.unary(function, argument)).transpose()?;
        self.beside(without, id)
    }

    /// Of `a operator b`, which is `id`; `divisor` is b.
    fn binary(
        &mut self,
        operator: Operator,
        (a, b): (Parts, Parts),
        divisor: NodeId,
        id: NodeId,
    ) -> Result<Parts, ExpressionError> {
        if a.added.is_none() && b.added.is_none() {
            return Ok(Parts { without: Some(id), added: None });
        }
        match operator {
            Operator::Add => {
                Ok(Parts { without: self.sum(a.without, b.without)?, added: self.sum(a.added, b.added)? })
            }
            Operator::Subtract => {
                let (without, added) = (self.negated(b.without)?, self.negated(b.added)?);
                Ok(Parts { without: self.sum(a.without, without)?, added: self.sum(a.added, added)? })
            }
            Operator::Multiply if b.added.is_none() => self.each(operator, a, b.without),
            Operator::Multiply if a.added.is_none() => self.each(operator, b, a.without),
            Operator::Multiply => {
                let without = self.both(operator, a.without, b.without)?;
                self.beside(without, id)
            }
            Operator::Divide if b.added.is_none() => self.each(operator, a, Some(divisor)),
            Operator::Divide => {
                let serves = b.without.filter(|id| self.graph.constant_value(*id).is_some());
                let without = self.both(operator, a.without, serves)?;
                self.beside(without, id)
            }
            Operator::Power => {
                let base = self.or_zero(a.without)?;
                let serves = b.added.is_none()
                    && (self.is_whole(divisor) || self.graph.constant_value(base).is_some_and(|c| c > 0.0));
                let without = serves.then(|| self.graph.binary(operator, base, divisor)).transpose()?;
                self.beside(without, id)
            }
        }
    }

    fn or_zero(&mut self, part: Option<NodeId>) -> Result<NodeId, ExpressionError> {
        part.map_or_else(|| self.graph.constant(0.0), Ok)
    }

    /// `without`, and what `whole` adds to it.
    fn beside(&mut self, without: Option<NodeId>, whole: NodeId) -> Result<Parts, ExpressionError> {
        // The sine of nothing is nothing, and its logarithm is no part.
        let is_part = |id: &NodeId| self.graph.constant_value(*id).is_none_or(|c| c != 0.0 && c.is_finite());
        let without = without.filter(is_part);
        let added = match without {
            Some(without) => self.graph.binary(Operator::Subtract, whole, without)?,
            None => whole,
        };
        Ok(Parts { without, added: Some(added) })
    }

    /// Each of the `parts` times or over `factor`.
    fn each(
        &mut self,
        operator: Operator,
        parts: Parts,
        factor: Option<NodeId>,
    ) -> Result<Parts, ExpressionError> {
        let without = self.both(operator, parts.without, factor)?;
        Ok(Parts { without, added: self.both(operator, parts.added, factor)? })
    }

    /// The product or quotient of both; none if one of them is.
    fn both(
        &mut self,
        operator: Operator,
        a: Option<NodeId>,
        b: Option<NodeId>,
    ) -> Result<Option<NodeId>, ExpressionError> {
        a.zip(b).map(|(a, b)| self.graph.binary(operator, a, b)).transpose()
    }

    fn sum(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Result<Option<NodeId>, ExpressionError> {
        match (a, b) {
            (Some(a), Some(b)) => self.graph.binary(Operator::Add, a, b).map(Some),
            (only, None) | (None, only) => Ok(only),
        }
    }

    fn negated(&mut self, a: Option<NodeId>) -> Result<Option<NodeId>, ExpressionError> {
        a.map(|a| self.graph.unary(Function::Negate, a)).transpose()
    }

    /// Whether the exponent `id` is a whole number, one at least.
    fn is_whole(&self, id: NodeId) -> bool {
        self.graph.constant_value(id).is_some_and(|exponent| exponent >= 1.0 && exponent.fract() == 0.0)
    }
}

#[cfg(test)]
mod tests {
    use crate::expression::Expression;

    /// The parts of `text` without the variable z, and what it adds, at the point (x, z).
    fn at(text: &str, x: f64, z: f64) -> [Option<f64>; 2] {
        let parts = Expression::parse(text, &["x", "z"]).unwrap().split_from(1).unwrap();
        parts.map(|part| part.map(|part| part.evaluate(&[x, z])))
    }

    #[test]
    fn the_parts_add_up_and_the_first_is_without_the_variables() {
        let texts = [
            "(x - 1)^2 + 0.1*z^2",
            "0.5*((x - 1)^2 - z^2)/x",
            "-(x + z)^3*(2 + z) - 1",
            "exp(x + z) - sin(z)*cos(x) - x^2*(1 + z^2)",
            "sqrt(1 + z^2)*x + abs(z - x) + x",
            "x/(1 + z) - tanh(z)",
            "x^2*sqrt(1 + z^2)/ln(2 + z) + (2 + z)^1.5",
        ];
        for text in texts {
            let expression = Expression::parse(text, &["x", "z"]).unwrap();
            let [without, added] = expression.split_from(1).unwrap().map(Option::unwrap);
            assert!(!without.depends_on(1), "{text}");
            for (x, z) in [(0.7, 0.3), (-1.2, 2.0)] {
                let (sum, whole) =
                    (without.evaluate(&[x, z]) + added.evaluate(&[x, z]), expression.evaluate(&[x, z]));
                assert!((sum - whole).abs() <= 1e-14 * (1.0 + whole.abs()), "{text}: {sum} and {whole}");
            }
        }
    }

    #[test]
    fn what_is_without_them_in_a_sum_is_exact() {
        assert_eq!(at("(x - 1)^2 + 0.1*z^2", 3.0, 2.0), [Some(4.0), Some(0.1 * 4.0)]);
        assert_eq!(at("x^2*(1 + z^2)", 3.0, 2.0), [Some(9.0), Some(36.0)]);
        assert_eq!(at("(x + z)^2", 3.0, 2.0), [Some(9.0), Some(16.0)]);
        assert_eq!(at("x^2*sqrt(1 + z^2)", 3.0, 0.0), [Some(9.0), Some(0.0)]);
        assert_eq!(at("x/(4 + z)", 3.0, -2.0), [Some(0.75), Some(0.75)]);
    }

    #[test]
    fn there_is_no_part_that_is_zero() {
        assert_eq!(at("x^2 - 1", 3.0, 2.0), [Some(8.0), None]);
        assert_eq!(at("x*z + z^2*sin(z)", 3.0, 0.0), [None, Some(0.0)]);
    }

    /// The logarithm is infinite at zero, and the roots have corners where x is zero.
    #[test]
    fn functions_that_zero_may_not_suit_stay_whole() {
        for text in ["x*ln(z^2)", "sqrt(z^2 + x^2)", "1/(z^2 + x)", "(z + x)^1.5", "abs(z + x)", "z^x"] {
            let [without, added] = at(text, 2.0, 1.0);
            let whole = Expression::parse(text, &["x", "z"]).unwrap().evaluate(&[2.0, 1.0]);
            assert_eq!((without, added), (None, Some(whole)), "{text}");
        }
    }
}
