//! The loop that runs a compiled program, one block of nodes at a time.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the tape's loop

use multiversion::multiversion;

use super::graph::sign;
use super::instruction::{Instruction, Operation};
use super::vector_math;

/// Nodes evaluated together: long enough to hide the dispatch, short enough for the scratch to stay in cache.
pub const LANES: usize = 64;

/// One register: the values of a subexpression at the nodes of a block.
pub(super) type Register = [f64; LANES];

/// One entry of a tape.
#[derive(Clone, Debug)]
pub(super) enum Placed {
    /// Operands are registers, none of them `target`.
    Compute { instruction: Instruction, target: usize },
    /// Copies a register to the nodes of an output.
    Store { output: usize, source: usize },
}

/// Runs `tape` over all nodes; the lengths have been checked by the caller.
// One build serves every machine. Nothing is contracted to FMA, so all versions agree to the last bit. The macro
// widens any AVX-512 target to the Ice Lake set, which spares older chips their AVX-512 clock penalty.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn run(
    tape: &[Placed],
    inputs: &[&[f64]],
    outputs: &mut [&mut [f64]],
    registers: &mut [Register],
) {
    let nodes = outputs[0].len();
    let mut start = 0;
    while start < nodes {
        let lanes = LANES.min(nodes - start);
        for placed in tape {
            match placed {
                Placed::Compute { instruction, target } => {
                    if let Operation::Load(variable) = instruction.operation {
                        load(&inputs[variable][start..start + lanes], &mut registers[*target]);
                    } else {
                        compute(instruction, *target, registers);
                    }
                }
                Placed::Store { output, source } => {
                    outputs[*output][start..start + lanes].copy_from_slice(&registers[*source][..lanes]);
                }
            }
        }
        start += lanes;
    }
}

/// Fills a register; lanes behind the last node repeat it, so that they stay ordinary numbers.
#[inline(always)]
fn load(nodes: &[f64], register: &mut Register) {
    if let Ok(block) = <&Register>::try_from(nodes) {
        *register = *block;
    } else {
        register.fill(nodes[nodes.len() - 1]);
        register[..nodes.len()].copy_from_slice(nodes);
    }
}

#[inline(always)]
fn compute(instruction: &Instruction, target: usize, registers: &mut [Register]) {
    let ([a, b], [c, d]) = (instruction.operands, instruction.constants);
    match instruction.operation {
        Operation::Load(_) => {}
        Operation::Constant => registers[target] = [c; LANES],
        Operation::AddConstant => unary(registers, target, a, |a| a + c),
        Operation::Scale => unary(registers, target, a, |a| c * a),
        Operation::Affine => unary(registers, target, a, |a| c * a + d),
        Operation::DivideConstant => unary(registers, target, a, |a| c / a),
        Operation::PowerConstant => unary(registers, target, a, |a| a.powf(c)),
        Operation::Square => unary(registers, target, a, |a| a * a),
        Operation::Add => binary(registers, target, a, b, |a, b| a + b),
        Operation::ScaleAdd => binary(registers, target, a, b, |a, b| c * a + b),
        Operation::Subtract => binary(registers, target, a, b, |a, b| a - b),
        Operation::Multiply => binary(registers, target, a, b, |a, b| a * b),
        Operation::Divide => binary(registers, target, a, b, |a, b| a / b),
        Operation::Power => binary(registers, target, a, b, f64::powf),
        Operation::Sign => unary(registers, target, a, sign),
        Operation::Exp => unary(registers, target, a, vector_math::exp),
        Operation::Ln => unary(registers, target, a, f64::ln),
        Operation::Sqrt => unary(registers, target, a, f64::sqrt),
        Operation::Sin => unary(registers, target, a, f64::sin),
        Operation::Cos => unary(registers, target, a, f64::cos),
        Operation::Tan => unary(registers, target, a, f64::tan),
        Operation::Sinh => unary(registers, target, a, f64::sinh),
        Operation::Cosh => unary(registers, target, a, f64::cosh),
        Operation::Tanh => unary(registers, target, a, f64::tanh),
        Operation::Abs => unary(registers, target, a, f64::abs),
    }
}

#[inline(always)]
fn unary(registers: &mut [Register], target: usize, a: usize, f: impl Fn(f64) -> f64) {
    let Ok([out, a]) = registers.get_disjoint_mut([target, a]) else { unreachable!("registers overlap") };
    for i in 0..LANES {
        out[i] = f(a[i]);
    }
}

#[inline(always)]
fn binary(registers: &mut [Register], target: usize, a: usize, b: usize, f: impl Fn(f64, f64) -> f64) {
    if a == b {
        return unary(registers, target, a, |a| f(a, a));
    }
    let Ok([out, a, b]) = registers.get_disjoint_mut([target, a, b]) else {
        unreachable!("registers overlap")
    };
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}
