//! Expressions with their derivatives, as programs.

use super::Order;
use crate::expression::{Expression, ExpressionError, Program};

/// Functions with their first derivatives, compiled without and with the second ones, which a gradient does not pay for.
#[derive(Clone, Debug)]
pub(super) struct Differentiated {
    gradient: Program,
    hessian: Program,
    scratch: Vec<f64>,
}

impl Differentiated {
    /// f and f′ of each function, by the variable beside it, then f″ of each.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative is too large.
    pub(super) fn along(functions: &[(&Expression, usize)]) -> Result<Self, ExpressionError> {
        let (mut up_to_first, mut second) = (Vec::new(), Vec::new());
        for (function, variable) in functions {
            let first = function.derivative(*variable)?;
            second.push(first.derivative(*variable)?);
            up_to_first.extend([(*function).clone(), first]);
        }
        Ok(Self::compile(up_to_first, second))
    }

    /// The function, its derivatives by each of its `variables` variables, and the second ones in the packed order of
    /// [`Jet`](super::Jet).
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative is too large.
    pub(super) fn by_each(function: &Expression, variables: usize) -> Result<Self, ExpressionError> {
        let mut up_to_first = vec![function.clone()];
        for variable in 0..variables {
            up_to_first.push(function.derivative(variable)?);
        }
        let mut second = Vec::new();
        for a in 0..variables {
            for b in 0..=a {
                second.push(up_to_first[1 + a].derivative(b)?);
            }
        }
        Ok(Self::compile(up_to_first, second))
    }

    fn compile(up_to_first: Vec<Expression>, second: Vec<Expression>) -> Self {
        let of_gradient = up_to_first.len();
        let all: Vec<Expression> = up_to_first.into_iter().chain(second).collect();
        let all: Vec<&Expression> = all.iter().collect();
        let (gradient, hessian) = (Program::compile(&all[..of_gradient]), Program::compile(&all));
        let scratch = vec![0.0; gradient.scratch_len().max(hessian.scratch_len())];
        Self { gradient, hessian, scratch }
    }

    /// Number of the functions with all their derivatives.
    pub(super) fn outputs(&self) -> usize {
        self.hessian.outputs()
    }

    /// The functions and their derivatives up to `order`, but at least the first, into as many of `outputs`; see [`Program::evaluate`].
    pub(super) fn evaluate(&mut self, order: Order, inputs: &[&[f64]], outputs: &mut [&mut [f64]]) {
        let program = if order < Order::Hessian { &self.gradient } else { &self.hessian };
        program.evaluate(inputs, &mut outputs[..program.outputs()], &mut self.scratch);
    }
}
