//! Relative norm of errors: each block of the state against the norm of that block. See `THEORY.md`, eq. (I1).

use std::ops::Range;

use super::Problem;
use crate::geometry::vectors::dot;

/// ‖e‖² = Σ |`e_b|²/|y_b|²` over the blocks b of the state y: errors relative to each. See `THEORY.md`, eq. (I1).
#[derive(Clone, Debug)]
pub struct ErrorNorm {
    blocks: Vec<Range<usize>>,
    /// `1/|y_b|²` of each block.
    weights: Vec<f64>,
}

impl ErrorNorm {
    /// A norm for the blocks of `problem`; call [`ErrorNorm::rescale`] before use.
    #[must_use]
    pub fn new(problem: &dyn Problem) -> Self {
        let blocks = problem.blocks();
        Self { weights: vec![1.0; blocks.len()], blocks }
    }

    /// Measures errors against the state `y` from now on.
    pub fn rescale(&mut self, problem: &dyn Problem, y: &[f64]) {
        for (index, (block, weight)) in self.blocks.iter().zip(&mut self.weights).enumerate() {
            let square = dot(&y[block.clone()], &y[block.clone()]);
            *weight = 1.0 / square.max(problem.block_floor(index, y));
        }
    }

    /// Inner product of the norm.
    #[must_use]
    pub fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        let blocks = self.blocks.iter().zip(&self.weights);
        blocks.map(|(block, weight)| weight * dot(&a[block.clone()], &b[block.clone()])).sum()
    }

    /// The norm.
    #[must_use]
    pub fn norm(&self, e: &[f64]) -> f64 {
        self.product(e, e).sqrt()
    }
}

/// Panics unless `y` is a state of `problem` and `tolerance` one that errors can meet: no step would be short enough otherwise, and
/// the message would be about the steps.
#[track_caller]
pub(super) fn check_start(problem: &dyn Problem, y: &[f64], tolerance: f64) {
    assert_eq!(y.len(), problem.size(), "length of the state at the start");
    assert!(
        tolerance > 0.0 && tolerance.is_finite(),
        "a tolerance of {tolerance:?}: it must be positive and finite"
    );
}
