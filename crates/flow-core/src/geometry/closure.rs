//! Projection onto closed curves: κ += aγ₁ + bγ₂ + c, the directions in which closure can fail.
//! See `THEORY.md`, eq. (G5).

use super::embedding::Embedding;

/// The curve could not be closed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the curve does not close: after {iterations} corrections its ends are {gap:.3e} apart, on a length of \
     {length:.6e}; use more nodes, or a tighter tolerance"
)]
pub struct ClosureError {
    /// Remaining gap |γ(1) − γ(0)|.
    pub gap: f64,
    /// Length of the curve.
    pub length: f64,
    /// Corrections tried.
    pub iterations: usize,
}

/// Closes curves by Newton's method on the gap.
#[derive(Clone, Debug)]
pub struct Closure {
    embedding: Embedding,
}

/// Gap per length at which a curve counts as closed.
const CLOSED: f64 = 2e-13;
const MOST_CORRECTIONS: usize = 8;

impl Closure {
    /// A projection on a grid of `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self { embedding: Embedding::new(nodes) }
    }

    /// Corrects `turning` (K = κ|Γ|) in place and returns the gap before the correction.
    ///
    /// The total turning is reset to 2π `turning_number`. The tangents of the closed curve, for the mean
    /// tangent angle `angle`, are in [`Closure::embedding`] afterwards.
    ///
    /// # Errors
    /// [`ClosureError`] if Newton's method does not reach rounding; `turning` is then meaningless.
    pub fn project(
        &mut self,
        turning: &mut [f64],
        length: f64,
        turning_number: i32,
        angle: f64,
    ) -> Result<f64, ClosureError> {
        let nodes = turning.len() as f64;
        let excess = turning.iter().sum::<f64>() / nodes - std::f64::consts::TAU * f64::from(turning_number);
        turning.iter_mut().for_each(|k| *k -= excess);
        let mut first_gap = 0.0;
        let mut gap = f64::INFINITY;
        for iteration in 0..MOST_CORRECTIONS {
            self.embedding.set_tangent(turning, length, angle);
            let [gx, gy] = self.embedding.gap();
            gap = gx.hypot(gy);
            if iteration == 0 {
                first_gap = gap;
            }
            if gap <= CLOSED * length {
                return Ok(first_gap);
            }
            self.embedding.set_position(length, [0.0; 2]);
            let [x, y] = self.embedding.position();
            let moment = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / nodes;
            let (xx, xy, yy) = (moment(x, x), moment(x, y), moment(y, y));
            // δ(gap) = (∫y δK, −∫x δK) for δK = a x + b y.
            let determinant = xx * yy - xy * xy;
            let (a, b) = ((xy * gx + yy * gy) / determinant, -(xx * gx + xy * gy) / determinant);
            for ((k, x), y) in turning.iter_mut().zip(x).zip(y) {
                *k += a * x + b * y;
            }
        }
        Err(ClosureError { gap, length, iterations: MOST_CORRECTIONS })
    }

    /// Tangents and positions of the curve projected last.
    pub fn embedding(&mut self) -> &mut Embedding {
        &mut self.embedding
    }
}
