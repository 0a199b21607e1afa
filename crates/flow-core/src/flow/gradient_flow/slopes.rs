//! How the energy changes with the state, at the state evaluated last.

use bytemuck::cast_slice;

use super::GradientFlow;
use crate::geometry::vectors::{dot, sum_of_moduli};

impl GradientFlow {
    /// Σ|∂𝓕/∂yᵢ|‖y‖ over the spectral state `y`, which must be the one evaluated last, with the norm of the field that yᵢ
    /// belongs to: the relative rounding of the nodal fields changes the energy by up to this much.
    #[must_use]
    pub fn energy_sensitivity(&self, y: &[f64]) -> f64 {
        let layout = self.spectral_layout();
        let modes = layout.modes();
        let by_field = self.gradient.spectra.chunks_exact(modes).zip(layout.spectra(y).chunks_exact(modes));
        let fields = by_field.map(|(p, phi)| {
            let [mean, last] = self.counted_once(modes);
            let slopes = 2.0 * sum_of_moduli(p) - mean * p[0].norm() - last * p[modes - 1].norm();
            let twice = 2.0 * dot(cast_slice(phi), cast_slice(phi));
            let square = twice - mean * phi[0].norm_sqr() - last * phi[modes - 1].norm_sqr();
            slopes * square.max(0.0).sqrt()
        });
        fields.sum::<f64>() + (self.gradient.by_length * y[layout.length_index()]).abs()
    }

    /// Derivative of the energy along the spectral `direction`.
    #[must_use]
    pub fn energy_slope(&self, direction: &[f64]) -> f64 {
        let layout = self.spectral_layout();
        let modes = layout.modes();
        let by_field =
            self.gradient.spectra.chunks_exact(modes).zip(layout.spectra(direction).chunks_exact(modes));
        let fields = by_field.map(|(p, phi)| {
            let [mean, last] = self.counted_once(modes);
            let product = |mode: usize| p[mode].re * phi[mode].re + p[mode].im * phi[mode].im;
            2.0 * dot(cast_slice(p), cast_slice(phi)) - mean * product(0) - last * product(modes - 1)
        });
        fields.sum::<f64>() + self.gradient.by_length * direction[layout.length_index()]
    }

    /// All modes count twice but for the mean and the sawtooth: how often these two count less.
    fn counted_once(&self, modes: usize) -> [f64; 2] {
        [0, modes - 1].map(|mode| 2.0 - self.map.multiplicity(mode))
    }
}
