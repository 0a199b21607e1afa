//! From expression graphs to instructions: constants folded into operations, powers into products.

use super::graph::{Function, Node, Operator};
use super::instruction::{Instruction, Operation, Table, ValueId};

/// Largest power, in absolute value, that becomes multiplications.
const MAX_PRODUCT_POWER: u32 = 32;
/// Factors between the inverse of this and this may change places in a product without leaving the float range.
const MODERATE: f64 = 18446744073709551616.0; // 2⁶⁴

/// Turns graphs into one shared table of instructions.
#[derive(Default)]
pub(super) struct Lowering {
    pub(super) table: Table,
}

impl Lowering {
    /// Adds the graph `nodes` and returns its value.
    pub(super) fn add(&mut self, nodes: &[Node]) -> ValueId {
        let mut values: Vec<ValueId> = Vec::with_capacity(nodes.len());
        for node in nodes {
            let value = match *node {
                Node::Constant(value) => self.constant(value),
                Node::Variable(variable) => self.table.intern(Operation::Load(variable), [0; 2], [0.0; 2]),
                Node::Unary(function, a) => self.function(function, values[a]),
                Node::Binary(operator, a, b) => self.operator(operator, values[a], values[b]),
            };
            values.push(value);
        }
        values[values.len() - 1]
    }

    fn operator(&mut self, operator: Operator, a: ValueId, b: ValueId) -> ValueId {
        match operator {
            Operator::Add => self.sum(a, b),
            Operator::Subtract => self.difference(a, b),
            Operator::Multiply => self.product(a, b),
            Operator::Divide => self.quotient(a, b),
            Operator::Power => self.power(a, b),
        }
    }

    fn function(&mut self, function: Function, a: ValueId) -> ValueId {
        if let Some(value) = self.constant_value(a) {
            return self.constant(function.apply(value));
        }
        let operation = match function {
            Function::Negate => return self.scaled(a, -1.0),
            Function::Sign => Operation::Sign,
            Function::Exp => Operation::Exp,
            Function::Ln => Operation::Ln,
            Function::Sqrt => Operation::Sqrt,
            Function::Sin => Operation::Sin,
            Function::Cos => Operation::Cos,
            Function::Tan => Operation::Tan,
            Function::Sinh => Operation::Sinh,
            Function::Cosh => Operation::Cosh,
            Function::Tanh => Operation::Tanh,
            Function::Abs => Operation::Abs,
        };
        self.table.intern(operation, [a, 0], [0.0; 2])
    }

    fn constant(&mut self, value: f64) -> ValueId {
        self.table.intern(Operation::Constant, [0; 2], [value, 0.0])
    }

    fn constant_value(&self, id: ValueId) -> Option<f64> {
        match self.table.get(id) {
            Instruction { operation: Operation::Constant, constants: [value, _], .. } => Some(value),
            _ => None,
        }
    }

    /// `id` as a moderate factor and what it multiplies; the factor is 1 where there is none.
    fn factor(&self, id: ValueId) -> (f64, ValueId) {
        match self.table.get(id) {
            Instruction { operation: Operation::Scale, operands: [a, _], constants: [c, _] }
                if is_moderate(c) =>
            {
                (c, a)
            }
            _ => (1.0, id),
        }
    }

    fn sum(&mut self, a: ValueId, b: ValueId) -> ValueId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => return self.constant(a + b),
            (None, Some(c)) => return self.shifted(a, c),
            (Some(c), None) => return self.shifted(b, c),
            (None, None) => {}
        }
        let ((c, scaled), (d, other_scaled)) = (self.factor(a), self.factor(b));
        if c != 1.0 {
            self.scale_add(scaled, c, b)
        } else if d != 1.0 {
            self.scale_add(other_scaled, d, a)
        } else {
            self.table.intern(Operation::Add, [a.min(b), a.max(b)], [0.0; 2])
        }
    }

    /// `c a + b`.
    fn scale_add(&mut self, a: ValueId, c: f64, b: ValueId) -> ValueId {
        if c == -1.0 {
            self.table.intern(Operation::Subtract, [b, a], [0.0; 2])
        } else {
            self.table.intern(Operation::ScaleAdd, [a, b], [c, 0.0])
        }
    }

    /// `a + c`.
    fn shifted(&mut self, a: ValueId, c: f64) -> ValueId {
        let (factor, scaled) = self.factor(a);
        if c == 0.0 {
            a
        } else if factor == 1.0 {
            self.table.intern(Operation::AddConstant, [a, 0], [c, 0.0])
        } else {
            self.table.intern(Operation::Affine, [scaled, 0], [factor, c])
        }
    }

    fn difference(&mut self, a: ValueId, b: ValueId) -> ValueId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => return self.constant(a - b),
            (None, Some(c)) => return self.shifted(a, -c),
            (Some(c), None) => {
                let negated = self.scaled(b, -1.0);
                return self.shifted(negated, c);
            }
            (None, None) => {}
        }
        let (d, scaled) = self.factor(b);
        if d == 1.0 {
            self.table.intern(Operation::Subtract, [a, b], [0.0; 2])
        } else {
            self.sum_with_negated(a, scaled, d)
        }
    }

    /// `a − d b`.
    fn sum_with_negated(&mut self, a: ValueId, b: ValueId, d: f64) -> ValueId {
        if d == -1.0 { self.sum(a, b) } else { self.scale_add(b, -d, a) }
    }

    /// `c a`.
    fn scaled(&mut self, a: ValueId, c: f64) -> ValueId {
        let (factor, inner) = self.factor(a);
        if c == 1.0 {
            a
        } else if factor == 1.0 || !is_moderate(c) {
            self.table.intern(Operation::Scale, [a, 0], [c, 0.0])
        } else if c * factor == 1.0 {
            inner
        } else {
            self.table.intern(Operation::Scale, [inner, 0], [c * factor, 0.0])
        }
    }

    fn product(&mut self, a: ValueId, b: ValueId) -> ValueId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => return self.constant(a * b),
            (None, Some(c)) => return self.scaled(a, c),
            (Some(c), None) => return self.scaled(b, c),
            (None, None) => {}
        }
        // Factors move outwards, where they merge.
        let ((c, a), (d, b)) = (self.factor(a), self.factor(b));
        let product = if a == b {
            self.table.intern(Operation::Square, [a, 0], [0.0; 2])
        } else {
            self.table.intern(Operation::Multiply, [a.min(b), a.max(b)], [0.0; 2])
        };
        self.scaled(product, c * d)
    }

    fn quotient(&mut self, a: ValueId, b: ValueId) -> ValueId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => self.constant(a / b),
            (None, Some(c)) if is_moderate(c) => self.scaled(a, 1.0 / c),
            (Some(c), None) => self.table.intern(Operation::DivideConstant, [b, 0], [c, 0.0]),
            _ => {
                let (c, a) = self.factor(a);
                let quotient = self.table.intern(Operation::Divide, [a, b], [0.0; 2]);
                self.scaled(quotient, c)
            }
        }
    }

    fn power(&mut self, a: ValueId, b: ValueId) -> ValueId {
        match (self.constant_value(a), self.constant_value(b)) {
            (Some(a), Some(b)) => self.constant(a.powf(b)),
            (None, Some(0.5)) => self.table.intern(Operation::Sqrt, [a, 0], [0.0; 2]),
            (None, Some(c)) if c.fract() == 0.0 && c.abs() <= f64::from(MAX_PRODUCT_POWER) => {
                let power = self.integer_power(a, c.abs() as u32);
                if c >= 0.0 {
                    power
                } else {
                    self.table.intern(Operation::DivideConstant, [power, 0], [1.0, 0.0])
                }
            }
            (None, Some(c)) => self.table.intern(Operation::PowerConstant, [a, 0], [c, 0.0]),
            _ => self.table.intern(Operation::Power, [a, b], [0.0; 2]),
        }
    }

    /// `aⁿ` by repeated squaring; the squares are shared with other powers of `a`.
    fn integer_power(&mut self, a: ValueId, n: u32) -> ValueId {
        match n {
            0 => self.constant(1.0),
            1 => a,
            _ => {
                let half = self.integer_power(a, n / 2);
                let even = self.product(half, half);
                if n.is_multiple_of(2) { even } else { self.product(even, a) }
            }
        }
    }
}

fn is_moderate(c: f64) -> bool {
    (1.0 / MODERATE..=MODERATE).contains(&c.abs())
}

#[cfg(test)]
mod tests {
    use super::super::Expression;
    use super::*;

    fn collect(table: &Table, id: ValueId, out: &mut Vec<Operation>) {
        table.get(id).read().iter().for_each(|&operand| collect(table, operand, out));
        out.push(table.get(id).operation);
    }

    /// The operations of a value, operands first.
    fn operations(text: &str) -> Vec<Operation> {
        let mut lowering = Lowering::default();
        let expression = Expression::parse(text, &["x", "y"]).unwrap();
        let value = lowering.add(expression.nodes());
        let mut out = Vec::new();
        collect(&lowering.table, value, &mut out);
        out.retain(|operation| !matches!(operation, Operation::Load(_)));
        out
    }

    #[test]
    fn constants_take_no_instruction_of_their_own() {
        assert_eq!(
            operations("-(x - 1)^2*3/4"),
            [Operation::AddConstant, Operation::Square, Operation::Scale]
        );
        assert_eq!(operations("1 - 2*x"), [Operation::Affine]);
        assert_eq!(operations("y - 2*x"), [Operation::ScaleAdd]);
        assert_eq!(operations("2/x"), [Operation::DivideConstant]);
        assert_eq!(operations("(2*x)*(y/2)"), [Operation::Multiply]);
        assert_eq!(operations("--x"), []);
    }

    #[test]
    fn small_integer_powers_are_products() {
        assert_eq!(operations("x^3"), [Operation::Square, Operation::Multiply]);
        assert_eq!(operations("x^4"), [Operation::Square, Operation::Square]);
        assert_eq!(operations("x^-2"), [Operation::Square, Operation::DivideConstant]);
        assert_eq!(operations("x^0.5"), [Operation::Sqrt]);
        assert_eq!(operations("x^1.5"), [Operation::PowerConstant]);
        assert_eq!(operations("x^0"), [Operation::Constant]);
    }
}
