//! Exchange with the surroundings, the Allen–Cahn flow: 𝓖 = Id. See `THEORY.md`, eq. (F15).

use super::DensityMobility;
use crate::geometry::{Complex64, Grading, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// The mass is not conserved.
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
    fn follow(&mut self, grading: &Grading) {
        if let Some(graded) = &mut self.graded {
            graded.follow(grading);
        }
    }

    fn apply(&mut self, _: f64, potential: &[Complex64], out: &mut [Complex64]) {
        out.copy_from_slice(potential);
        if let Some(graded) = &mut self.graded {
            graded.weigh(out);
        }
    }

    fn symbol(&self, _: f64, _: f64) -> f64 {
        1.0
    }

    fn order(&self) -> usize {
        0
    }

    fn three_points(&self, _: usize, _: usize, _: f64) -> [f64; 3] {
        [0.0, 1.0, 0.0]
    }

    fn conserves_mass(&self) -> bool {
        false
    }
}
