//! Diffusion along the curve: 𝓖 = −`Δ_s`. See `THEORY.md`, eq. (F5).

use super::DensityMobility;
use crate::flow::CurveFields;
use crate::geometry::vectors::{apply_real_symbol, scale};
use crate::geometry::{Complex64, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// Diffusion, 𝓖 = −`Δ_s` by the second derivative of the family; the mass is conserved. See `THEORY.md`, eq. (F5).
#[derive(Clone, Debug)]
pub struct Diffusion {
    minus_laplacian: Vec<f64>,
    graded: Option<GradedLaplacian>,
}

impl Diffusion {
    /// The mobility on the nodes of `derivative`.
    #[must_use]
    pub fn new(grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        Self {
            minus_laplacian: derivative.minus_laplacian().to_vec(),
            graded: GradedLaplacian::of(grid, derivative),
        }
    }
}

impl DensityMobility for Diffusion {
    fn apply(&mut self, at: &CurveFields, potential: &[Complex64], out: &mut [Complex64]) {
        let factor = 1.0 / (at.length() * at.length());
        if let Some((graded, grading)) = self.graded.as_mut().zip(at.grading()) {
            graded.apply(grading, potential, out);
            scale(bytemuck::cast_slice_mut(out), factor);
            return;
        }
        apply_real_symbol(out, factor, potential, &self.minus_laplacian);
    }

    fn symbol(&self, minus_laplacian: f64, length: f64) -> f64 {
        minus_laplacian / (length * length)
    }

    fn order(&self) -> usize {
        2
    }

    fn three_points(&self, at: &CurveFields, node: usize, nodes: usize) -> [f64; 3] {
        let scale = (nodes as f64 / at.length()).powi(2);
        let [left, right] = match at.grading() {
            None => [scale; 2],
            Some(grading) => grading.spacing(node, nodes).map(|spacing| scale * spacing),
        };
        [-left, left + right, -right]
    }

    fn conserves_mass(&self) -> bool {
        true
    }
}
