//! Diffusion along the curve: 𝓖 = −`Δ_s`. See `THEORY.md`, eq. (F5).

use super::DensityMobility;
use crate::geometry::Complex64;
use crate::operators::Derivative;

/// By the second derivative of the family; the mass is conserved.
#[derive(Clone, Debug)]
pub struct Diffusion {
    minus_laplacian: Vec<f64>,
}

impl Diffusion {
    /// The mobility on the grid of `derivative`.
    #[must_use]
    pub fn new(derivative: &Derivative) -> Self {
        Self { minus_laplacian: derivative.minus_laplacian().to_vec() }
    }
}

impl DensityMobility for Diffusion {
    fn name(&self) -> &'static str {
        "diffusion"
    }

    fn apply(&mut self, length: f64, potential: &[Complex64], out: &mut [Complex64]) {
        let scale = 1.0 / (length * length);
        for ((out, potential), symbol) in out.iter_mut().zip(potential).zip(&self.minus_laplacian) {
            *out = potential * (scale * symbol);
        }
    }

    fn symbol(&self, minus_laplacian: f64, length: f64) -> f64 {
        minus_laplacian / (length * length)
    }

    fn order(&self) -> usize {
        2
    }

    fn three_points(&self, _: usize, nodes: usize, length: f64) -> [f64; 3] {
        let scale = (nodes as f64 / length).powi(2);
        [-scale, 2.0 * scale, -scale]
    }

    fn conserves_mass(&self) -> bool {
        true
    }
}
