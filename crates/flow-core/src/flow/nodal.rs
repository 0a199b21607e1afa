//! The gradient flow on nodal state vectors: for tests, for data that comes from outside, for pictures.
//! The integrator works on spectral vectors (see `gradient_flow.rs`), which are longer: each function here panics if it is given one.

use super::gradient_flow::{GradientFlow, Rate};
use crate::geometry::SpectralLayout;

impl GradientFlow {
    /// Rate of the nodal state `y` into `rate`.
    ///
    /// # Panics
    /// If `y` or `rate` is no nodal vector of the layout.
    pub fn rate(&mut self, y: &[f64], rate: &mut [f64]) -> Rate {
        let state = self.encoded(y);
        let mut product = vec![0.0; state.len()];
        let evaluated = self.spectral_rate(&state, &mut product);
        self.decode(&product, rate);
        evaluated
    }

    /// Energy and dissipation of the nodal state `y`.
    ///
    /// # Panics
    /// If `y` is no nodal vector of the layout.
    pub fn dissipation_at(&mut self, y: &[f64]) -> Rate {
        let state = self.encoded(y);
        self.spectral_dissipation(&state)
    }

    /// Energy of the nodal state `y`.
    ///
    /// # Panics
    /// If `y` is no nodal vector of the layout.
    pub fn energy_at(&mut self, y: &[f64]) -> f64 {
        let state = self.encoded(y);
        self.spectral_gradient(&state)
    }

    /// Gradient of the energy at `y` as a vector dual to the state: ⟨·, ·⟩ of a dual vector and a motion is the mean
    /// over the nodes of the products of the fields plus the product of the lengths.
    ///
    /// # Panics
    /// If `y` or `out` is no nodal vector of the layout.
    pub fn gradient_at(&mut self, y: &[f64], out: &mut [f64]) -> f64 {
        let energy = self.energy_at(y);
        self.write_gradient(out);
        energy
    }

    /// Energy of each term at the nodal state `y`.
    ///
    /// # Panics
    /// If `y` is no nodal vector of the layout.
    pub fn energies_by_term(&mut self, y: &[f64]) -> Vec<f64> {
        self.energy_at(y);
        self.current_energies_by_term()
    }

    /// Freezes the implicit operator −𝓚 Hess `𝓕_h` at the nodal state `y`.
    ///
    /// # Panics
    /// If `y` is no nodal vector of the layout.
    pub fn linearise(&mut self, y: &[f64]) {
        let state = self.encoded(y);
        self.spectral_linearise(&state);
    }

    /// Product of the frozen −𝓚 Hess `𝓕_h` with the nodal vector `v`.
    ///
    /// # Panics
    /// Before [`GradientFlow::linearise`], or if a vector is no nodal one of the layout.
    pub fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        let motion = self.encoded(v);
        let mut product = vec![0.0; motion.len()];
        self.spectral_jacobian_product(&motion, &mut product);
        self.decode(&product, out);
    }

    /// Product of the frozen Hess `𝓕_h` with the nodal vector `v`, dual to the state (see [`GradientFlow::gradient_at`]).
    ///
    /// # Panics
    /// Before [`GradientFlow::linearise`], or if a vector is no nodal one of the layout.
    pub fn hessian_product(&mut self, v: &[f64], out: &mut [f64]) {
        let motion = self.encoded(v);
        self.spectral_hessian_product(&motion);
        self.write_gradient(out);
    }

    /// 𝓚 applied to the dual vector `dual`, at the frozen state.
    ///
    /// # Panics
    /// Before [`GradientFlow::linearise`], or if a vector is no nodal one of the layout.
    pub fn apply_mobility(&mut self, dual: &[f64], out: &mut [f64]) {
        let dual = self.encoded(dual);
        let mut product = vec![0.0; dual.len()];
        self.spectral_mobility(&dual, &mut product);
        self.decode(&product, out);
    }

    /// The length whose symbols stand for −`Δ_s` at the linearisation, the variation of the metric left out.
    #[must_use]
    pub(super) fn symbol_length(&self) -> f64 {
        let length = self.frozen().length();
        self.frozen().grading().map_or(length, |grading| length / grading.inverse_square_mean().sqrt())
    }

    /// Shape of the spectral state vector.
    #[must_use]
    pub fn spectral_layout(&self) -> SpectralLayout {
        SpectralLayout::new(self.layout())
    }

    pub(super) fn encoded(&mut self, nodal: &[f64]) -> Vec<f64> {
        let layout = self.spectral_layout();
        let mut state = vec![0.0; layout.len()];
        layout.encode(self.grid_mut(), nodal, &mut state);
        state
    }

    fn write_gradient(&mut self, out: &mut [f64]) {
        let layout = self.spectral_layout();
        let mut dual = vec![0.0; layout.len()];
        layout.spectra_mut(&mut dual).copy_from_slice(&self.gradient().spectra);
        dual[layout.length_index()] = self.gradient().by_length;
        self.decode(&dual, out);
    }

    /// Nodal values of a spectral vector.
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout, or `nodal` no nodal one.
    pub fn decode(&mut self, state: &[f64], nodal: &mut [f64]) {
        let layout = self.spectral_layout();
        let mut scratch = vec![crate::geometry::Complex64::default(); layout.modes()];
        layout.decode(self.grid_mut(), state, &mut scratch, nodal);
    }
}
