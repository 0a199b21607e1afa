//! Exchange with the surroundings, the Allen–Cahn flow: 𝓖 = Id. See `THEORY.md`, eq. (F15).

use super::DensityMobility;
use crate::flow::CurveFields;
use crate::geometry::{Complex64, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// Exchange with the surroundings, 𝓖 = Id; the mass is not conserved. See `THEORY.md`, eq. (F15).
#[derive(Clone, Debug)]
pub struct Exchange {
    graded: Option<GradedLaplacian>,
}

impl Exchange {
    /// The mobility on the nodes of `derivative`.
    #[must_use]
    pub fn new(grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        Self { graded: GradedLaplacian::of(grid, derivative) }
    }
}

impl DensityMobility for Exchange {
    fn apply(&mut self, at: &CurveFields, potential: &[Complex64], out: &mut [Complex64]) {
        out.copy_from_slice(potential);
        if let Some((graded, grading)) = self.graded.as_mut().zip(at.grading()) {
            graded.weigh(grading, out);
        }
    }

    fn symbol(&self, _: f64, _: f64) -> f64 {
        1.0
    }

    fn order(&self) -> usize {
        0
    }

    fn three_points(&self, _: &CurveFields, _: usize, _: usize) -> [f64; 3] {
        [0.0, 1.0, 0.0]
    }

    fn conserves_mass(&self) -> bool {
        false
    }
}
