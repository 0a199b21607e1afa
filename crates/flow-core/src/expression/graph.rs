//! Expressions as graphs in which equal subexpressions are one node.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::error::ExpressionError;

/// Most nodes one expression may have, its derivatives included.
pub(super) const MAX_NODES: usize = 20_000;

/// Position of a node in its graph; operands stand before the node that uses them.
pub(super) type NodeId = usize;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Function {
    Negate,
    /// −1, 0 or 1: the derivative of `abs`, zero at zero; no scene can name it.
    Sign,
    Exp,
    Ln,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Sinh,
    Cosh,
    Tanh,
    Abs,
}

/// The functions a scene may call.
pub(super) const NAMED_FUNCTIONS: [(&str, Function); 10] = [
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sqrt", Function::Sqrt),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("sinh", Function::Sinh),
    ("cosh", Function::Cosh),
    ("tanh", Function::Tanh),
    ("abs", Function::Abs),
];

impl Function {
    /// The value at `x`.
    pub(super) fn apply(self, x: f64) -> f64 {
        match self {
            Self::Negate => -x,
            Self::Sign => sign(x),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Sqrt => x.sqrt(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Abs => x.abs(),
        }
    }
}

/// −1, 0 or 1, and NaN for NaN.
#[allow(clippy::inline_always)] // must be compiled inside each version of the tape's loop
#[inline(always)]
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x / x.abs() }
}

/// An operation on two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

impl Operator {
    /// The value at `(x, y)`.
    pub(super) fn apply(self, x: f64, y: f64) -> f64 {
        match self {
            Self::Add => x + y,
            Self::Subtract => x - y,
            Self::Multiply => x * y,
            Self::Divide => x / y,
            Self::Power => x.powf(y),
        }
    }
}

/// One subexpression.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    Constant(f64),
    Variable(usize),
    Unary(Function, NodeId),
    Binary(Operator, NodeId, NodeId),
}

/// What makes two nodes the same; constants compare by their bits.
#[derive(PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Variable(usize),
    Unary(Function, NodeId),
    Binary(Operator, NodeId, NodeId),
}

/// A growing graph that stores each distinct node once.
#[derive(Default)]
pub(super) struct Graph {
    nodes: Vec<Node>,
    index: HashMap<Key, NodeId>,
}

impl Graph {
    /// A graph that starts with `nodes`, each keeping its position.
    pub(super) fn from_nodes(nodes: &[Node]) -> Self {
        let index = nodes.iter().enumerate().map(|(id, node)| (key(*node), id)).collect();
        Self { nodes: nodes.to_vec(), index }
    }

    /// The node itself.
    pub(super) fn node(&self, id: NodeId) -> Node {
        self.nodes[id]
    }

    /// The value of `id`, if it is a constant.
    pub(super) fn constant_value(&self, id: NodeId) -> Option<f64> {
        match self.nodes[id] {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    pub(super) fn constant(&mut self, value: f64) -> Result<NodeId, ExpressionError> {
        self.intern(Node::Constant(value))
    }

    pub(super) fn variable(&mut self, variable: usize) -> Result<NodeId, ExpressionError> {
        self.intern(Node::Variable(variable))
    }

    /// `function(a)`, evaluated now if `a` is a constant.
    pub(super) fn unary(&mut self, function: Function, a: NodeId) -> Result<NodeId, ExpressionError> {
        match self.constant_value(a) {
            Some(a) => self.constant(function.apply(a)),
            None => self.intern(Node::Unary(function, a)),
        }
    }

    /// `a operator b`, evaluated now if both are constants.
    pub(super) fn binary(
        &mut self,
        operator: Operator,
        a: NodeId,
        b: NodeId,
    ) -> Result<NodeId, ExpressionError> {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => self.constant(operator.apply(a, b)),
            _ => self.intern(Node::Binary(operator, a, b)),
        }
    }

    fn intern(&mut self, node: Node) -> Result<NodeId, ExpressionError> {
        match self.index.entry(key(node)) {
            Entry::Occupied(entry) => Ok(*entry.get()),
            Entry::Vacant(_) if self.nodes.len() >= MAX_NODES => {
                Err(ExpressionError::TooManyTerms { limit: MAX_NODES })
            }
            Entry::Vacant(entry) => {
                self.nodes.push(node);
                Ok(*entry.insert(self.nodes.len() - 1))
            }
        }
    }

    /// The nodes that `root` needs, in the same order, `root` last.
    pub(super) fn reachable(&self, root: NodeId) -> Vec<Node> {
        let mut needed = vec![false; root + 1];
        needed[root] = true;
        for id in (0..=root).rev() {
            if needed[id] {
                self.nodes[id].operands().for_each(|operand| needed[operand] = true);
            }
        }
        let mut position = vec![0; root + 1];
        let mut kept = Vec::new();
        for id in (0..=root).filter(|&id| needed[id]) {
            position[id] = kept.len();
            kept.push(match self.nodes[id] {
                Node::Unary(function, a) => Node::Unary(function, position[a]),
                Node::Binary(operator, a, b) => Node::Binary(operator, position[a], position[b]),
                leaf => leaf,
            });
        }
        kept
    }
}

impl Node {
    fn operands(self) -> impl Iterator<Item = NodeId> {
        let (a, b) = match self {
            Node::Constant(_) | Node::Variable(_) => (None, None),
            Node::Unary(_, a) => (Some(a), None),
            Node::Binary(_, a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }
}

fn key(node: Node) -> Key {
    match node {
        Node::Constant(value) => Key::Constant(value.to_bits()),
        Node::Variable(variable) => Key::Variable(variable),
        Node::Unary(function, a) => Key::Unary(function, a),
        Node::Binary(operator, a, b) => Key::Binary(operator, a, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_subexpressions_are_one_node() {
        let mut graph = Graph::default();
        let x = graph.variable(0).unwrap();
        let first = graph.unary(Function::Exp, x).unwrap();
        assert_eq!(graph.unary(Function::Exp, x).unwrap(), first);
        assert_eq!(graph.reachable(first).len(), 2);
    }

    #[test]
    fn sign_is_zero_at_zero_and_keeps_nan() {
        assert_eq!((sign(-2.0), sign(0.0), sign(-0.0), sign(3.0)), (-1.0, 0.0, 0.0, 1.0));
        assert!(sign(f64::NAN).is_nan());
    }
}
