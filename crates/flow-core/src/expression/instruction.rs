//! The operations a program is made of, and the table in which equal ones are stored once.

use std::collections::HashMap;

/// What an instruction does with its operands `a` and `b` and its constants `c` and `d`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    /// The input array of this index.
    Load(usize),
    /// `c`
    Constant,
    /// `a + c`
    AddConstant,
    /// `c a`
    Scale,
    /// `c a + d`
    Affine,
    /// `c / a`
    DivideConstant,
    /// `a ^ c`
    PowerConstant,
    /// `a²`
    Square,
    /// `a + b`
    Add,
    /// `c a + b`
    ScaleAdd,
    /// `a − b`
    Subtract,
    /// `a b`
    Multiply,
    /// `a / b`
    Divide,
    /// `a ^ b`
    Power,
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

impl Operation {
    /// How many of `a`, `b` are read.
    pub(super) fn operand_count(self) -> usize {
        match self {
            Self::Load(_) | Self::Constant => 0,
            Self::Add | Self::ScaleAdd | Self::Subtract | Self::Multiply | Self::Divide | Self::Power => 2,
            _ => 1,
        }
    }
}

/// An operation with its operands: values while a program is built, registers once it is placed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction {
    pub(super) operation: Operation,
    /// `[a, b]`; unused ones are zero.
    pub(super) operands: [usize; 2],
    /// `[c, d]`; unused ones are zero.
    pub(super) constants: [f64; 2],
}

impl Instruction {
    /// The operands that are read.
    pub(super) fn read(&self) -> &[usize] {
        &self.operands[..self.operation.operand_count()]
    }
}

/// Name of a value: its position in the table.
pub(super) type ValueId = usize;

/// What makes two instructions the same; constants compare by their bits.
type Key = (Operation, [usize; 2], [u64; 2]);

/// Instructions in an order in which operands come first, each distinct one once.
#[derive(Default)]
pub(super) struct Table {
    instructions: Vec<Instruction>,
    index: HashMap<Key, ValueId>,
}

impl Table {
    /// The instruction that computes `id`.
    pub(super) fn get(&self, id: ValueId) -> Instruction {
        self.instructions[id]
    }

    /// How many values there are.
    pub(super) fn len(&self) -> usize {
        self.instructions.len()
    }

    /// The value of this instruction, new or known.
    pub(super) fn intern(
        &mut self,
        operation: Operation,
        operands: [ValueId; 2],
        constants: [f64; 2],
    ) -> ValueId {
        let next = self.instructions.len();
        let id = *self.index.entry((operation, operands, constants.map(f64::to_bits))).or_insert(next);
        if id == next {
            self.instructions.push(Instruction { operation, operands, constants });
        }
        id
    }
}
