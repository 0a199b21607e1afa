//! Projection onto closed curves: κ += aγ₁ + bγ₂ + c, the directions in which closure can fail.
//! See `THEORY.md`, eq. (G5).

use std::sync::Arc;

use bytemuck::cast_slice;

use super::brief::Brief;
use super::embedding::Embedding;
use super::grading::Grading;
use super::grid::Complex64;
use super::vectors::dot;

/// The curve could not be closed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the curve does not close: after {iterations} corrections its ends are {} apart, on a length of {}; use more \
     nodes, or a tighter tolerance", Brief(*.gap), Brief(*.length)
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

/// Gap per length at which a curve counts as closed. It costs energy to the first order: at 2e-13 a flow at rest rose and fell by as
/// much of its energy, a hundred times the rounding.
const CLOSED: f64 = 2e-15;
/// Gap per length that one correction takes to rounding.
const CLOSED_BY_ONE: f64 = 1e-8;
const MOST_CORRECTIONS: usize = 8;

impl Closure {
    /// A projection on a grid of `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self::graded(nodes, None)
    }

    /// A projection on nodes that may be graded.
    #[must_use]
    pub fn graded(nodes: usize, grading: Option<Arc<Grading>>) -> Self {
        Self { embedding: Embedding::graded(nodes, grading) }
    }

    /// Corrects the spectrum `turning` of K = κg in place and returns the gap before the correction.
    ///
    /// The total turning is reset to 2π `turning_number`. The tangents of the closed curve (to 1e-8), for the
    /// mean tangent angle `angle`, are in [`Closure::embedding`] afterwards.
    ///
    /// # Errors
    /// [`ClosureError`] if Newton's method does not reach rounding; `turning` is then meaningless.
    /// # Panics
    /// If `turning` has not the modes of the grid.
    pub fn project(
        &mut self,
        turning: &mut [Complex64],
        length: f64,
        turning_number: i32,
        angle: f64,
    ) -> Result<f64, ClosureError> {
        let modes = self.embedding.shape_spectra()[0].len();
        assert_eq!(turning.len(), modes, "a spectrum on the grid of the projection");
        turning[0] = Complex64::new(std::f64::consts::TAU * f64::from(turning_number), 0.0);
        let mut first_gap = 0.0;
        let mut gap = f64::INFINITY;
        for iteration in 0..MOST_CORRECTIONS {
            self.embedding.set_tangent_spectrum(turning, length, angle);
            let [gx, gy] = self.embedding.gap();
            gap = gx.hypot(gy);
            if iteration == 0 {
                first_gap = gap;
            }
            if gap <= CLOSED * length {
                return Ok(first_gap);
            }
            let [x, y] = self.embedding.shape_spectra();
            let (xx, xy, yy) = (length * moment(x, x), length * moment(x, y), length * moment(y, y));
            // δ(gap) = (∫y δK ds, −∫x δK ds) for δK = a x + b y, with x and y per length.
            let determinant = xx * yy - xy * xy;
            let (a, b) = ((xy * gx + yy * gy) / determinant, -(xx * gx + xy * gy) / determinant);
            for ((k, x), y) in turning.iter_mut().zip(x).zip(y) {
                *k += x * a + y * b;
            }
            // Newton's method squares the gap: a small one is closed by one correction, unseen.
            if gap <= CLOSED_BY_ONE * length {
                return Ok(first_gap);
            }
        }
        Err(ClosureError { gap, length, iterations: MOST_CORRECTIONS })
    }

    /// Tangents and positions of the curve projected last.
    pub fn embedding(&mut self) -> &mut Embedding {
        &mut self.embedding
    }
}

/// Mean of the product of two fields without mean, by their spectra; the sawtooth counts twice.
pub(crate) fn moment(a: &[Complex64], b: &[Complex64]) -> f64 {
    2.0 * dot(cast_slice(a), cast_slice(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::PeriodicGrid;

    /// A gap that is small, but seen by the energy.
    #[test]
    fn small_gaps_are_closed_to_rounding_too() {
        let nodes = 64;
        let mut grid = PeriodicGrid::new(nodes);
        let mut turning = vec![Complex64::default(); grid.modes()];
        let bend = |node: usize| (3.0 * std::f64::consts::TAU * node as f64 / nodes as f64).cos();
        let values: Vec<f64> = (0..nodes).map(|node| std::f64::consts::TAU * (1.0 + bend(node))).collect();
        grid.transform(&values, &mut turning);
        let mut closure = Closure::new(nodes);
        closure.project(&mut turning, 1.0, 1, 0.0).unwrap();
        turning[1].re += 1e-13;
        let before = closure.project(&mut turning, 1.0, 1, 0.0).unwrap();
        let after = closure.project(&mut turning, 1.0, 1, 0.0).unwrap();
        assert!(before > 1e-14 && after < 4e-15, "{before:.1e}, {after:.1e}");
    }
}
