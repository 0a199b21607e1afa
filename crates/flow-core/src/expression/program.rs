//! Several expressions compiled together: the order of the instructions and the registers they use.

use super::instruction::{Instruction, Operation, Table, ValueId};
use super::lower::Lowering;
use super::symbolic::Expression;
use super::tape::{self, LANES, Placed};

/// Several expressions of the same variables, compiled to be evaluated at every node of a curve.
///
/// Subexpressions that occur more than once, in one output or in several, are computed once.
#[derive(Clone, Debug)]
pub struct Program {
    tape: Vec<Placed>,
    outputs: usize,
    registers: usize,
    /// Indices of the variables that are read, in increasing order.
    variables: Vec<usize>,
}

impl Program {
    /// Compiles `outputs`, which must have been parsed with the same list of variables.
    #[must_use]
    pub fn compile(outputs: &[&Expression]) -> Self {
        let mut lowering = Lowering::default();
        let roots: Vec<ValueId> = outputs.iter().map(|output| lowering.add(output.nodes())).collect();
        let (tape, registers) = place(&lowering.table, &roots);
        let mut variables: Vec<usize> = tape.iter().filter_map(Placed::variable).collect();
        variables.sort_unstable();
        Self { tape, outputs: roots.len(), registers, variables }
    }

    /// The number of expressions.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// Length of the scratch array that [`evaluate`](Self::evaluate) needs, whatever the number of nodes.
    #[must_use]
    pub fn scratch_len(&self) -> usize {
        self.registers * LANES
    }

    /// Evaluates every output at every node, without allocating; what `scratch` held before does not matter.
    ///
    /// The results do not depend on the instruction set of the machine, except through the standard library's
    /// own functions (all but `exp`, `sqrt` and `abs`).
    /// # Shapes
    /// `inputs[v][i]`: variable `v` at node `i`; a variable that no output depends on may have any length.
    /// `outputs[k][i]`: expression `k` at node `i`. `scratch`: at least [`scratch_len`](Self::scratch_len) long.
    /// # Panics
    /// If a length differs from these shapes.
    pub fn evaluate(&self, inputs: &[&[f64]], outputs: &mut [&mut [f64]], scratch: &mut [f64]) {
        assert_eq!(outputs.len(), self.outputs, "one output array per expression");
        assert!(scratch.len() >= self.scratch_len(), "scratch is shorter than `scratch_len`");
        let Some(nodes) = outputs.first().map(|output| output.len()) else { return };
        assert!(outputs.iter().all(|output| output.len() == nodes), "outputs of different lengths");
        for &variable in &self.variables {
            assert_eq!(inputs[variable].len(), nodes, "length of the input of variable {variable}");
        }
        let (registers, _) = scratch.as_chunks_mut::<LANES>();
        tape::run(&self.tape, inputs, outputs, registers);
    }
}

/// The instructions that `roots` need, operands first, with results in as few registers as their lives allow.
fn place(table: &Table, roots: &[ValueId]) -> (Vec<Placed>, usize) {
    let order = depth_first(table, roots);
    let mut readers = vec![0_usize; table.len()];
    for &id in &order {
        table.get(id).read().iter().for_each(|&operand| readers[operand] += 1);
    }
    let mut register = vec![0; table.len()];
    let (mut free, mut registers) = (Vec::new(), 0);
    let mut tape = Vec::with_capacity(order.len() + roots.len());
    for id in order {
        let Instruction { operation, operands, constants } = table.get(id);
        // The target is taken before the operands are released: they are never the same array.
        let target = free.pop().unwrap_or_else(|| {
            registers += 1;
            registers - 1
        });
        register[id] = target;
        let operands = operands.map(|operand| register[operand]);
        tape.push(Placed::Compute { instruction: Instruction { operation, operands, constants }, target });
        let stored = roots.iter().enumerate().filter(|(_, root)| **root == id);
        tape.extend(stored.map(|(output, _)| Placed::Store { output, source: target }));
        for &operand in table.get(id).read() {
            readers[operand] -= 1;
            if readers[operand] == 0 {
                free.push(register[operand]);
            }
        }
        if readers[id] == 0 {
            free.push(target);
        }
    }
    (tape, registers)
}

/// Every value that `roots` need, each after its operands and close to its first reader.
fn depth_first(table: &Table, roots: &[ValueId]) -> Vec<ValueId> {
    let mut order = Vec::new();
    let mut entered = vec![false; table.len()];
    // A stack of our own: a long sum is a deep graph.
    let mut stack: Vec<(ValueId, bool)> = roots.iter().rev().map(|&root| (root, false)).collect();
    while let Some((id, operands_done)) = stack.pop() {
        if operands_done {
            order.push(id);
        } else if !entered[id] {
            entered[id] = true;
            stack.push((id, true));
            stack.extend(table.get(id).read().iter().rev().map(|&operand| (operand, false)));
        }
    }
    order
}

impl Placed {
    /// The variable this loads, if it is a load.
    fn variable(&self) -> Option<usize> {
        match self {
            Self::Compute {
                instruction: Instruction { operation: Operation::Load(variable), .. }, ..
            } => Some(*variable),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(text: &str) -> Program {
        Program::compile(&[&Expression::parse(text, &["x", "y"]).unwrap()])
    }

    #[test]
    fn registers_are_reused() {
        assert_eq!(program("sin(cos(exp(sin(x))))").scratch_len(), 2 * LANES);
        let long_sum: Vec<String> = (0..300).map(|k| format!("sin(x+{k})")).collect();
        assert!(program(&long_sum.join("+")).scratch_len() <= 5 * LANES);
    }

    #[test]
    fn shared_subexpressions_are_computed_once() {
        let r = Expression::parse("exp(-(x - 1)^2)", &["x"]).unwrap();
        let (r_x, r_xx) = (r.derivative(0).unwrap(), r.derivative(0).unwrap().derivative(0).unwrap());
        let program = Program::compile(&[&r, &r_x, &r_xx]);
        let is_exp = |placed: &&Placed| format!("{placed:?}").contains("Exp");
        assert_eq!(program.tape.iter().filter(is_exp).count(), 1);
    }

    #[test]
    fn the_same_expression_may_be_several_outputs() {
        let (x, two) = (Expression::parse("x", &["x"]).unwrap(), Expression::constant(2.0));
        let program = Program::compile(&[&x, &two, &x]);
        let (mut a, mut b, mut c) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        let mut scratch = vec![f64::NAN; program.scratch_len()];
        program.evaluate(&[&[3.0, 4.0]], &mut [&mut a, &mut b, &mut c], &mut scratch);
        assert_eq!((a, b, c), ([3.0, 4.0], [2.0, 2.0], [3.0, 4.0]));
    }

    #[test]
    fn no_outputs_and_no_nodes_are_allowed() {
        Program::compile(&[]).evaluate(&[], &mut [], &mut []);
        let program = program("x");
        program.evaluate(&[&[]], &mut [&mut []], &mut vec![0.0; program.scratch_len()]);
    }
}
