//! An expression as what can be taken at the nodes, and what slopes need the flux points for.

use super::error::ExpressionError;
use super::graph::{Function, Graph, Node, NodeId, Operator};

/// Highest degree of what is subtracted at the flux points, to be added at the nodes: an interpolant has no larger square than its
/// field, but it may overshoot, and the differences of higher powers have no bound below.
const MOST_SUBTRACTED: u32 = 2;
/// Degree of what is no polynomial.
const NO_POLYNOMIAL: u32 = 99;

/// The two parts of a subexpression; none stands for zero.
#[derive(Clone, Copy)]
struct Parts {
    /// The value where the slopes are zero.
    without: Option<NodeId>,
    added: Option<NodeId>,
    /// Degree of what is subtracted in the second part, if anything is.
    subtracted: Option<u32>,
}

impl Parts {
    fn plain(id: NodeId) -> Self {
        Self { without: Some(id), added: None, subtracted: None }
    }

    fn whole(id: NodeId) -> Self {
        Self { without: None, added: Some(id), subtracted: None }
    }
}

/// The last of `nodes` as the sum of a function without slopes, the variables from `first` on, and of the rest; none where that is
/// zero.
///
/// The first part has the addends with variables that are `bare`: their slopes do not occur. As far as sums, factors and squares go,
/// what slopes add to such addends is in the second part.
pub(super) fn split(
    nodes: &[Node],
    first: usize,
    bare: &dyn Fn(usize) -> bool,
) -> Result<[Option<Vec<Node>>; 2], ExpressionError> {
    let mut rules = Rules { graph: Graph::from_nodes(nodes), bare };
    let mut parts: Vec<Parts> = Vec::with_capacity(nodes.len());
    for (id, node) in nodes.iter().enumerate() {
        parts.push(match *node {
            Node::Variable(variable) if variable >= first => Parts::whole(id),
            Node::Constant(_) | Node::Variable(_) => Parts::plain(id),
            Node::Unary(function, a) => rules.unary(function, parts[a], id)?,
            Node::Binary(operator, a, b) => rules.binary(operator, [(a, parts[a]), (b, parts[b])], id)?,
        });
    }
    let Some(root) = parts.last() else { return Ok([None, None]) };
    let [at_nodes, rest] = rules.by_bareness(root.without)?;
    let at_flux_points = rules.sum(root.added, rest)?;
    Ok([at_nodes, at_flux_points].map(|id| id.map(|id| rules.graph.reachable(id))))
}

struct Rules<'a> {
    graph: Graph,
    bare: &'a dyn Fn(usize) -> bool,
}

type Part = Result<Option<NodeId>, ExpressionError>;

impl Rules<'_> {
    fn unary(&mut self, function: Function, a: Parts, id: NodeId) -> Result<Parts, ExpressionError> {
        if a.added.is_none() {
            return Ok(Parts::plain(id));
        }
        if function == Function::Negate {
            return Ok(Parts { without: self.negated(a.without)?, added: self.negated(a.added)?, ..a });
        }
        match a.without.and_then(|argument| self.graph.constant_value(argument)) {
            Some(argument) => self.beside_constant(function.apply(argument), id),
            None => Ok(Parts::whole(id)),
        }
    }

    /// Of `a operator b`, which is `id`.
    fn binary(
        &mut self,
        operator: Operator,
        [(a_id, a), (b_id, b)]: [(NodeId, Parts); 2],
        id: NodeId,
    ) -> Result<Parts, ExpressionError> {
        if a.added.is_none() && b.added.is_none() {
            return Ok(Parts::plain(id));
        }
        let subtracted = a.subtracted.max(b.subtracted);
        match operator {
            Operator::Add => Ok(Parts {
                without: self.sum(a.without, b.without)?,
                added: self.sum(a.added, b.added)?,
                subtracted,
            }),
            Operator::Subtract => {
                let (without, added) = (self.negated(b.without)?, self.negated(b.added)?);
                Ok(Parts {
                    without: self.sum(a.without, without)?,
                    added: self.sum(a.added, added)?,
                    subtracted,
                })
            }
            Operator::Multiply | Operator::Divide if b.added.is_none() => self.each(operator, a, b_id, id),
            Operator::Multiply if a.added.is_none() => self.each(operator, b, a_id, id),
            Operator::Multiply if a_id == b_id => self.square(a, id),
            Operator::Power if self.graph.constant_value(b_id) == Some(2.0) => self.square(a, id),
            Operator::Multiply | Operator::Divide | Operator::Power => Ok(Parts::whole(id)),
        }
    }

    /// Each of the `parts` times or over `factor`, which has no slopes; that is `id`.
    fn each(
        &mut self,
        operator: Operator,
        parts: Parts,
        factor: NodeId,
        id: NodeId,
    ) -> Result<Parts, ExpressionError> {
        let degree = match operator {
            Operator::Divide if self.degree(factor) > 0 => NO_POLYNOMIAL,
            _ => self.degree(factor),
        };
        let subtracted = parts.subtracted.map(|subtracted| subtracted.saturating_add(degree));
        if subtracted.is_some_and(|subtracted| subtracted > MOST_SUBTRACTED) {
            return Ok(Parts::whole(id));
        }
        let [without, added] = self.scaled(operator, [parts.without, parts.added], factor)?;
        Ok(Parts { without, added, subtracted })
    }

    /// Of the square `id` of what has the parts `base`.
    fn square(&mut self, base: Parts, id: NodeId) -> Result<Parts, ExpressionError> {
        let Some(without) = base.without.filter(|without| self.degree(*without) <= 1) else {
            return Ok(Parts::whole(id));
        };
        if let Some(constant) = self.graph.constant_value(without) {
            return self.beside_constant(constant * constant, id);
        }
        let square = self.graph.binary(Operator::Multiply, without, without)?;
        let added = self.graph.binary(Operator::Subtract, id, square)?;
        Ok(Parts { without: Some(square), added: Some(added), subtracted: Some(2) })
    }

    /// Of `id`, which is `constant` without slopes.
    fn beside_constant(&mut self, constant: f64, id: NodeId) -> Result<Parts, ExpressionError> {
        if constant == 0.0 || !constant.is_finite() {
            return Ok(Parts::whole(id));
        }
        let without = self.graph.constant(constant)?;
        let added = self.graph.binary(Operator::Subtract, id, without)?;
        Ok(Parts { without: Some(without), added: Some(added), subtracted: Some(0) })
    }

    /// `id` as the sum of the addends with and without variables that are bare.
    fn by_bareness(&mut self, id: Option<NodeId>) -> Result<[Option<NodeId>; 2], ExpressionError> {
        let Some(id) = id else { return Ok([None, None]) };
        if !self.has_bare(id) {
            return Ok([None, Some(id)]);
        }
        match self.graph.node(id) {
            Node::Unary(Function::Negate, a) => {
                let [bare, rest] = self.by_bareness(Some(a))?;
                Ok([self.negated(bare)?, self.negated(rest)?])
            }
            Node::Binary(operator @ (Operator::Add | Operator::Subtract), a, b) => {
                let b = if operator == Operator::Add { b } else { self.graph.unary(Function::Negate, b)? };
                let [bare_a, rest_a] = self.by_bareness(Some(a))?;
                let [bare_b, rest_b] = self.by_bareness(Some(b))?;
                Ok([self.sum(bare_a, bare_b)?, self.sum(rest_a, rest_b)?])
            }
            Node::Binary(operator @ (Operator::Multiply | Operator::Divide), a, b)
                if self.graph.constant_value(b).is_some() =>
            {
                let parts = self.by_bareness(Some(a))?;
                self.scaled(operator, parts, b)
            }
            Node::Binary(Operator::Multiply, a, b) if self.graph.constant_value(a).is_some() => {
                let parts = self.by_bareness(Some(b))?;
                self.scaled(Operator::Multiply, parts, a)
            }
            _ => Ok([Some(id), None]),
        }
    }

    /// Both parts times or over `factor`.
    fn scaled(
        &mut self,
        operator: Operator,
        [one, other]: [Option<NodeId>; 2],
        factor: NodeId,
    ) -> Result<[Option<NodeId>; 2], ExpressionError> {
        let mut times =
            |part: Option<NodeId>| part.map(|part| self.graph.binary(operator, part, factor)).transpose();
        Ok([times(one)?, times(other)?])
    }

    fn sum(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Part {
        match (a, b) {
            (Some(a), Some(b)) => self.graph.binary(Operator::Add, a, b).map(Some),
            (only, None) | (None, only) => Ok(only),
        }
    }

    fn negated(&mut self, a: Option<NodeId>) -> Part {
        a.map(|a| self.graph.unary(Function::Negate, a)).transpose()
    }

    fn has_bare(&self, id: NodeId) -> bool {
        self.graph.reachable(id).iter().any(|node| matches!(node, Node::Variable(v) if (self.bare)(*v)))
    }

    /// Degree of `id` as a polynomial of its variables, at most.
    fn degree(&self, id: NodeId) -> u32 {
        match self.graph.node(id) {
            Node::Constant(_) => 0,
            Node::Variable(_) => 1,
            Node::Unary(Function::Negate, a) => self.degree(a),
            Node::Binary(Operator::Add | Operator::Subtract, a, b) => self.degree(a).max(self.degree(b)),
            Node::Binary(Operator::Multiply, a, b) => self.degree(a).saturating_add(self.degree(b)),
            Node::Binary(Operator::Divide, a, b) if self.graph.constant_value(b).is_some() => self.degree(a),
            Node::Binary(Operator::Power, a, b) if self.graph.constant_value(b) == Some(2.0) => {
                self.degree(a).saturating_mul(2)
            }
            Node::Unary(..) | Node::Binary(..) => NO_POLYNOMIAL,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::expression::Expression;

    /// The parts of `text` in x, y, the slope z and no slope of x, at a point.
    fn at(text: &str, point: [f64; 3]) -> [Option<f64>; 2] {
        let expression = Expression::parse(text, &["x", "y", "z"]).unwrap();
        let parts = expression.split_from(2, &|variable| variable == 0).unwrap();
        assert!(parts[0].as_ref().is_none_or(|part| !part.depends_on(2)), "{text}");
        parts.map(|part| part.map(|part| part.evaluate(&point)))
    }

    #[test]
    fn the_parts_add_up() {
        for text in [
            "(x - 1)^2 + 0.1*z^2",
            "0.5*((x - y)^2 - z^2)/2",
            "-(x + z)^2*3 - 1",
            "x^2*(1 + z^2) - (y^2 - 1)^2*2",
            "x*sqrt(1 + z^2) - (y - (x - z)*(x - z))",
            "x/(1 + z) - tanh(z) + exp(x + z) - (x + z)^4",
        ] {
            let whole = Expression::parse(text, &["x", "y", "z"]).unwrap();
            for point in [[0.7, 0.4, 0.3], [-1.2, 1.7, 2.0]] {
                let sum: f64 = at(text, point).into_iter().flatten().sum();
                let value = whole.evaluate(&point);
                assert!((sum - value).abs() <= 1e-14 * (1.0 + value.abs()), "{text}: {sum} and {value}");
            }
        }
    }

    #[test]
    fn sums_factors_and_squares_are_split() {
        let point = [3.0, 0.5, 2.0];
        assert_eq!(at("(x - 1)^2 + 0.25*z^2", point), [Some(4.0), Some(1.0)]);
        assert_eq!(at("((x - 1)^2 + z^2)/2", point), [Some(2.0), Some(2.0)]);
        assert_eq!(at("x^4*(1 + z^2)", point), [Some(81.0), Some(324.0)]);
        assert_eq!(at("(x + z)^2", point), [Some(9.0), Some(16.0)]);
        assert_eq!(at("x^2*sqrt(5 - z^2)", [3.0, 0.5, 0.0]).map(|part| part.is_some()), [true, true]);
        assert_eq!(at("2*x - x*z", point), [Some(6.0), Some(-6.0)]);
    }

    /// What stands beside the slope of its own variable has its cost between the nodes.
    #[test]
    fn variables_with_slopes_stay_with_them() {
        assert_eq!(at("(y^2 - 1)^2 + z^2", [3.0, 2.0, 1.0]), [None, Some(10.0)]);
        assert_eq!(at("x*y + y^2 + z", [3.0, 2.0, 1.0]), [Some(6.0), Some(5.0)]);
        assert_eq!(at("2*(x - y^2)/4 - z", [3.0, 2.0, 1.0]), [Some(1.5), Some(-3.0)]);
    }

    /// The interpolant of x overshoots x: Σx⁴ − Σ(Mx)⁴ over the nodes and between them has no bound below.
    #[test]
    fn nothing_beyond_a_square_is_subtracted_between_the_nodes() {
        for text in [
            "(x + z)^4",
            "cosh(x + z)",
            "exp(x + z)",
            "(x + z)^2*(x + z)^2",
            "x*(x + z)^2",
            "(x^2 + z)^2",
            "x^4*sqrt(1 + z^2)",
            "x^2*sqrt(1 + z^2)/(1 + x^2)",
            "abs(z + x)",
            "1/(z^2 + x)",
        ] {
            let [at_nodes, at_flux_points] = at(text, [2.0, 0.0, 1.0]);
            let whole = Expression::parse(text, &["x", "y", "z"]).unwrap().evaluate(&[2.0, 0.0, 1.0]);
            assert_eq!((at_nodes, at_flux_points), (None, Some(whole)), "{text}");
        }
    }
}
