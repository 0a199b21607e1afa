//! Exact derivatives, node by node, with the zeros and ones of the chain rule folded away.

use super::error::ExpressionError;
use super::graph::{Function, Graph, Node, NodeId, Operator};

/// The graph of the derivative by `variable` of the last of `nodes`.
pub(super) fn differentiate(nodes: &[Node], variable: usize) -> Result<Vec<Node>, ExpressionError> {
    let mut rules = Rules { graph: Graph::from_nodes(nodes) };
    // `None` stands for a derivative that is zero everywhere.
    let mut slopes: Vec<Option<NodeId>> = Vec::with_capacity(nodes.len());
    for (id, node) in nodes.iter().enumerate() {
        let slope = match *node {
            Node::Variable(index) if index == variable => Some(rules.graph.constant(1.0)?),
            Node::Constant(_) | Node::Variable(_) => None,
            Node::Unary(function, a) => match slopes[a] {
                Some(da) => rules.chain(function, a, da, id)?,
                None => None,
            },
            Node::Binary(operator, a, b) => match operator {
                Operator::Add => rules.sum(slopes[a], slopes[b])?,
                Operator::Subtract => rules.difference(slopes[a], slopes[b])?,
                Operator::Multiply => rules.product(a, b, slopes[a], slopes[b])?,
                Operator::Divide => rules.quotient(b, slopes[a], slopes[b], id)?,
                Operator::Power => rules.power(a, b, slopes[a], slopes[b], id)?,
            },
        };
        slopes.push(slope);
    }
    let root = match slopes.last().copied().flatten() {
        Some(root) => root,
        None => rules.graph.constant(0.0)?,
    };
    Ok(rules.graph.reachable(root))
}

struct Rules {
    graph: Graph,
}

type Slope = Result<Option<NodeId>, ExpressionError>;

impl Rules {
    /// `(f(a))'`, where `value` is `f(a)`.
    fn chain(&mut self, function: Function, a: NodeId, da: NodeId, value: NodeId) -> Slope {
        let slope = match function {
            Function::Sign => return Ok(None),
            Function::Negate => return self.negated(da).map(Some),
            Function::Exp => value,
            Function::Ln => return self.divided(da, a).map(Some),
            Function::Sqrt => {
                let half = self.graph.constant(0.5)?;
                self.divided(half, value)?
            }
            Function::Sin => self.graph.unary(Function::Cos, a)?,
            Function::Cos => {
                let sin = self.graph.unary(Function::Sin, a)?;
                self.negated(sin)?
            }
            Function::Tan => self.one_and_square(Operator::Add, value)?,
            Function::Sinh => self.graph.unary(Function::Cosh, a)?,
            Function::Cosh => self.graph.unary(Function::Sinh, a)?,
            Function::Tanh => self.one_and_square(Operator::Subtract, value)?,
            Function::Abs => self.graph.unary(Function::Sign, a)?,
        };
        self.times(slope, da).map(Some)
    }

    /// `1 ± value²`.
    fn one_and_square(&mut self, operator: Operator, value: NodeId) -> Result<NodeId, ExpressionError> {
        let (one, square) = (self.graph.constant(1.0)?, self.graph.binary(Operator::Multiply, value, value)?);
        self.graph.binary(operator, one, square)
    }

    fn sum(&mut self, da: Option<NodeId>, db: Option<NodeId>) -> Slope {
        match (da, db) {
            (Some(da), Some(db)) => self.graph.binary(Operator::Add, da, db).map(Some),
            (only, None) | (None, only) => Ok(only),
        }
    }

    fn difference(&mut self, da: Option<NodeId>, db: Option<NodeId>) -> Slope {
        match (da, db) {
            (Some(da), Some(db)) => self.graph.binary(Operator::Subtract, da, db).map(Some),
            (None, Some(db)) => self.negated(db).map(Some),
            (da, None) => Ok(da),
        }
    }

    /// `a'b + ab'`.
    fn product(&mut self, a: NodeId, b: NodeId, da: Option<NodeId>, db: Option<NodeId>) -> Slope {
        let left = da.map(|da| self.times(da, b)).transpose()?;
        let right = db.map(|db| self.times(a, db)).transpose()?;
        self.sum(left, right)
    }

    /// `(a' − (a/b) b') / b`, where `value` is `a/b`.
    fn quotient(&mut self, b: NodeId, da: Option<NodeId>, db: Option<NodeId>, value: NodeId) -> Slope {
        let right = db.map(|db| self.times(value, db)).transpose()?;
        let numerator = self.difference(da, right)?;
        numerator.map(|numerator| self.divided(numerator, b)).transpose()
    }

    /// `b a^(b−1) a' + a^b ln(a) b'`, where `value` is `a^b`; the second part is 0 at a = 0 for b > 0.
    fn power(
        &mut self,
        a: NodeId,
        b: NodeId,
        da: Option<NodeId>,
        db: Option<NodeId>,
        value: NodeId,
    ) -> Slope {
        let by_base = match da {
            Some(da) => {
                let one = self.graph.constant(1.0)?;
                let lowered = self.graph.binary(Operator::Subtract, b, one)?;
                let lowered = self.raised(a, lowered)?;
                let slope = self.times(b, lowered)?;
                Some(self.times(slope, da)?)
            }
            None => None,
        };
        let by_exponent = match db {
            Some(db) => {
                let ln = self.logarithm(a, value)?;
                let slope = self.times(value, ln)?;
                Some(self.times(slope, db)?)
            }
            None => None,
        };
        self.sum(by_base, by_exponent)
    }

    /// `ln(a)`, but 0 where `value` = `a^b` is 0: `a^b ln(a)` has the limit 0 there, and 0·(−∞) is no number.
    fn logarithm(&mut self, a: NodeId, value: NodeId) -> Result<NodeId, ExpressionError> {
        if self.graph.constant_value(a).is_some_and(|base| base > 0.0) {
            return self.graph.unary(Function::Ln, a);
        }
        let sign = self.graph.unary(Function::Sign, value)?;
        let (one, size) = (self.graph.constant(1.0)?, self.graph.unary(Function::Abs, sign)?);
        let vanishes = self.graph.binary(Operator::Subtract, one, size)?;
        let base = self.graph.binary(Operator::Add, a, vanishes)?;
        self.graph.unary(Function::Ln, base)
    }

    fn negated(&mut self, a: NodeId) -> Result<NodeId, ExpressionError> {
        match self.graph.node(a) {
            Node::Unary(Function::Negate, inner) => Ok(inner),
            _ => self.graph.unary(Function::Negate, a),
        }
    }

    fn times(&mut self, a: NodeId, b: NodeId) -> Result<NodeId, ExpressionError> {
        match (self.graph.constant_value(a), self.graph.constant_value(b)) {
            (Some(0.0 | 1.0), Some(0.0 | 1.0)) => self.graph.binary(Operator::Multiply, a, b),
            (Some(0.0), _) | (_, Some(1.0)) => Ok(a),
            (_, Some(0.0)) | (Some(1.0), _) => Ok(b),
            _ => self.graph.binary(Operator::Multiply, a, b),
        }
    }

    fn divided(&mut self, a: NodeId, b: NodeId) -> Result<NodeId, ExpressionError> {
        match (self.graph.constant_value(a), self.graph.constant_value(b)) {
            (_, Some(1.0)) => Ok(a),
            _ => self.graph.binary(Operator::Divide, a, b),
        }
    }

    fn raised(&mut self, a: NodeId, exponent: NodeId) -> Result<NodeId, ExpressionError> {
        match self.graph.constant_value(exponent) {
            Some(0.0) => self.graph.constant(1.0),
            Some(1.0) => Ok(a),
            _ => self.graph.binary(Operator::Power, a, exponent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Expression;
    use super::*;

    fn slope(text: &str) -> Expression {
        Expression::parse(text, &["x", "y"]).unwrap().derivative(0).unwrap()
    }

    #[test]
    fn small_cases_simplify_completely() {
        for (text, nodes) in
            [("x", 1), ("x + y", 1), ("3*x", 1), ("x^2", 3), ("x*y", 1), ("y^3", 1), ("x^1", 1)]
        {
            assert_eq!(slope(text).nodes().len(), nodes, "{text}");
        }
        assert_eq!(slope("x^0").evaluate(&[0.0, 0.0]), 0.0);
        assert!(!slope("5*x + y").depends_on(0));
    }

    #[test]
    fn powers_of_negative_bases_stay_finite() {
        let curvature = slope("(x - 1.0)^2").derivative(0).unwrap();
        assert_eq!(slope("(x - 1.0)^2").evaluate(&[-2.0, 0.0]), -6.0);
        assert_eq!(curvature.evaluate(&[-2.0, 0.0]), 2.0);
    }

    #[test]
    fn abs_has_slope_zero_at_zero() {
        assert_eq!(slope("abs(x)").evaluate(&[0.0, 0.0]), 0.0);
        assert_eq!(slope("abs(x)").evaluate(&[-3.0, 0.0]), -1.0);
    }

    #[test]
    fn the_slope_by_an_exponent_vanishes_with_the_power() {
        let by_exponent = |text: &str| Expression::parse(text, &["x", "y"]).unwrap().derivative(1).unwrap();
        for (x, y, expected) in [
            (0.0, 2.0, 0.0),
            (0.0, 0.5, 0.0),
            (0.0, 0.0, f64::NEG_INFINITY),
            (2.0, 3.0, 8.0 * 2_f64.ln()),
            (1e-200, 2.0, 0.0),
        ] {
            assert_eq!(by_exponent("x^y").evaluate(&[x, y]), expected, "{x}^{y}");
        }
        assert!(by_exponent("x^y").evaluate(&[-2.0, 3.0]).is_nan());
        assert!(by_exponent("x^y").evaluate(&[0.0, -1.0]).is_nan());
        let twice = by_exponent("x^y^2").derivative(1).unwrap();
        assert_eq!(twice.evaluate(&[0.0, 1.5]), 0.0);
        assert_eq!(by_exponent("x^y").derivative(0).unwrap().evaluate(&[0.0, 1.5]), 0.0);
        assert_eq!(
            by_exponent("2^y").nodes().len(),
            Expression::parse("2^y*0.6931", &["x", "y"]).unwrap().nodes().len()
        );
    }

    #[test]
    fn growth_is_bounded() {
        let mut expression = Expression::parse("exp(sin(x*y))^y", &["x", "y"]).unwrap();
        let error = loop {
            match expression.derivative(0) {
                Ok(next) => expression = next,
                Err(error) => break error,
            }
        };
        assert!(matches!(error, ExpressionError::TooManyTerms { .. }));
    }
}
