//! How the energy changes with the state, at the state evaluated last.

use super::GradientFlow;
use crate::geometry::Complex64;
use crate::geometry::vectors::sum_of_moduli;

impl GradientFlow {
    /// Σ|∂𝓕/∂yᵢ|‖y‖ over the spectral state `y`, which must be the one evaluated last, with the norm of the field that yᵢ
    /// belongs to: the relative rounding of the nodal fields changes the energy by up to this much.
    #[must_use]
    pub fn energy_sensitivity(&self, y: &[f64]) -> f64 {
        let fields = self.with_gradients(y).map(|(p, phi)| {
            // All modes count twice, but for the mean and the sawtooth.
            let [mean, last] = [0, p.len() - 1].map(|mode| 2.0 - self.descent.map.multiplicity(mode));
            let slopes = 2.0 * sum_of_moduli(p) - mean * p[0].norm() - last * p[p.len() - 1].norm();
            slopes * self.descent.map.mean_product(phi, phi).max(0.0).sqrt()
        });
        fields.sum::<f64>()
            + (self.descent.gradient.by_length * y[self.spectral_layout().length_index()]).abs()
    }

    /// Derivative of the energy along the spectral `direction`.
    #[must_use]
    pub fn energy_slope(&self, direction: &[f64]) -> f64 {
        let fields = self.with_gradients(direction).map(|(p, phi)| self.descent.map.mean_product(p, phi));
        fields.sum::<f64>()
            + self.descent.gradient.by_length * direction[self.spectral_layout().length_index()]
    }

    /// The fields of the spectral `state`, each after the derivative of the energy by it.
    fn with_gradients<'a>(
        &'a self,
        state: &'a [f64],
    ) -> impl Iterator<Item = (&'a [Complex64], &'a [Complex64])> {
        let layout = self.spectral_layout();
        let modes = layout.modes();
        self.descent.gradient.spectra.chunks_exact(modes).zip(layout.spectra(state).chunks_exact(modes))
    }
}
