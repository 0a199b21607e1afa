//! Diffusion with a fixed weight w(s) > 0: 𝓖 = −∇_s(w∇_s·). See `THEORY.md`, eq. (F14).
//!
//! On the grid 𝓖 = −D₋(w D₊ ·)/L², w at the flux points, where the grading divides it; the part of the second derivative that D₊ does not see (the
//! sawtooth of the Fourier family) has the mean weight. A constant weight w is w times plain diffusion.

use super::DensityMobility;
use crate::flow::CurveFields;
use crate::geometry::vectors::multiply;
use crate::geometry::{Complex64, PeriodicGrid};
use crate::operators::Derivative;

/// Diffusion with a weight w(s) > 0 fixed on the parameter, 𝓖 = −∇_s(w∇_s·); the mass is conserved. See `THEORY.md`, eq. (F14).
#[derive(Clone, Debug)]
pub struct WeightedDiffusion {
    grid: PeriodicGrid,
    to_flux: Vec<Complex64>,
    /// The second derivative less D₊ᵀD₊.
    unseen: Vec<f64>,
    weight: Vec<f64>,
    mean: f64,
    /// Distance of the first flux point from the first node, in node distances.
    offset: f64,
    flux: Vec<f64>,
}

impl WeightedDiffusion {
    /// The mobility with the values `weight` > 0 at the flux points, which are at [`WeightedDiffusion::flux_points`].
    ///
    /// # Panics
    /// If there is not one weight per flux point.
    #[must_use]
    pub fn new(grid: &PeriodicGrid, derivative: &Derivative, weight: Vec<f64>) -> Self {
        assert_eq!(weight.len(), grid.nodes(), "one weight per flux point");
        let to_flux = derivative.to_flux().to_vec();
        let unseen =
            derivative.minus_laplacian().iter().zip(&to_flux).map(|(l, d)| l - d.norm_sqr()).collect();
        Self {
            grid: grid.clone(),
            to_flux,
            unseen,
            mean: weight.iter().sum::<f64>() / weight.len() as f64,
            weight,
            offset: Self::offset(derivative),
            flux: vec![0.0; grid.nodes()],
        }
    }

    fn offset(derivative: &Derivative) -> f64 {
        if derivative.interpolation().is_some() { 0.5 } else { 0.0 }
    }

    /// Parameters of the flux points.
    #[must_use]
    pub fn flux_points(grid: &PeriodicGrid, derivative: &Derivative) -> Vec<f64> {
        let offset = Self::offset(derivative);
        (0..grid.nodes()).map(|i| (i as f64 + offset) / grid.nodes() as f64).collect()
    }

    /// The weight at any parameter in [0, 1), by linear interpolation.
    fn weight_at(&self, parameter: f64) -> f64 {
        let count = self.weight.len();
        let place = (parameter * count as f64 - self.offset).rem_euclid(count as f64);
        let (left, part) = (place as usize % count, place.fract());
        (1.0 - part) * self.weight[left] + part * self.weight[(left + 1) % count]
    }
}

impl DensityMobility for WeightedDiffusion {
    fn apply(&mut self, at: &CurveFields, potential: &[Complex64], out: &mut [Complex64]) {
        for ((slope, potential), symbol) in out.iter_mut().zip(potential).zip(&self.to_flux) {
            *slope = potential * symbol;
        }
        self.grid.synthesise(out, &mut self.flux);
        for (flux, weight) in self.flux.iter_mut().zip(&self.weight) {
            *flux *= weight;
        }
        if let Some(grading) = at.grading() {
            multiply(&mut self.flux, grading.inverse_at_midpoints());
        }
        self.grid.transform(&self.flux, out);
        let scale = 1.0 / (at.length() * at.length());
        let symbols = self.to_flux.iter().zip(&self.unseen);
        for ((out, potential), (to_flux, unseen)) in out.iter_mut().zip(potential).zip(symbols) {
            *out = (*out * to_flux.conj() + potential * (self.mean * unseen)) * scale;
        }
    }

    fn symbol(&self, minus_laplacian: f64, length: f64) -> f64 {
        self.mean * minus_laplacian / (length * length)
    }

    fn order(&self) -> usize {
        2
    }

    fn three_points(&self, at: &CurveFields, node: usize, nodes: usize) -> [f64; 3] {
        let scale = (nodes as f64 / at.length()).powi(2);
        let weight = |shift: f64| scale * self.weight_at((node as f64 + shift) / nodes as f64);
        let [near, far] = at.grading().map_or([1.0; 2], |grading| grading.spacing(node, nodes));
        let (left, right) = (near * weight(-0.5), far * weight(0.5));
        [-left, left + right, -right]
    }

    fn conserves_mass(&self) -> bool {
        true
    }
}
