//! The flow map A: normal velocity ↦ rates of the state, gauge included, and its exact transpose.
//!
//! Scaled arc-length gauge: ∂_sW = −|Γ|κV + ∂_t|Γ|, so that the metric stays uniform. See `THEORY.md`, eqs. (F1)–(F3).

use super::curve_fields::CurveFields;
use crate::geometry::{Complex64, Layout, PeriodicGrid};
use crate::operators::Derivative;

/// Applies A and Aᵀ on one grid; holds all scratch.
#[derive(Clone, Debug)]
pub struct FlowMap {
    layout: Layout,
    grid: PeriodicGrid,
    derivative: Derivative,
    values: Vec<f64>,
    product: Vec<f64>,
    spectrum: Vec<Complex64>,
    tangential: Vec<f64>,
}

impl FlowMap {
    /// A flow map for states of `layout`.
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let field = vec![0.0; layout.nodes()];
        Self {
            layout,
            grid: grid.clone(),
            derivative: derivative.clone(),
            values: field.clone(),
            product: field.clone(),
            spectrum: vec![Complex64::default(); grid.modes()],
            tangential: field,
        }
    }

    /// Grid and derivative, for others who work on the same nodes.
    pub fn grid_and_derivative(&mut self) -> (&mut PeriodicGrid, &Derivative) {
        (&mut self.grid, &self.derivative)
    }

    /// How often a mode stands in the full spectrum.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        self.grid.multiplicity(mode)
    }

    /// Force f = −Aᵀ∇𝓕 of a gradient given by the spectra `gradient` (one per field, per unit length) and
    /// `by_length` = ∂𝓕/∂|Γ| at fixed K and m. f is a density in L²(dσ).
    pub fn force(&mut self, at: &CurveFields, gradient: &[Complex64], by_length: f64, force: &mut [f64]) {
        let modes = self.grid.modes();
        // z = Σ φ ∂_s p over the fields, at the flux points.
        for field in 0..self.layout.fields() {
            let p = &gradient[field * modes..(field + 1) * modes];
            for ((slope, p), symbol) in self.spectrum.iter_mut().zip(p).zip(self.derivative.to_flux()) {
                *slope = p * symbol;
            }
            self.grid.synthesise(&self.spectrum, &mut self.values);
            let phi = at.at_flux_points(field);
            if field == 0 {
                for ((z, slope), phi) in self.product.iter_mut().zip(&self.values).zip(phi) {
                    *z = phi * slope;
                }
            } else {
                for ((z, slope), phi) in self.product.iter_mut().zip(&self.values).zip(phi) {
                    *z += phi * slope;
                }
            }
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        for (z, symbol) in self.spectrum.iter_mut().zip(self.derivative.inverse_to_flux()) {
            *z *= symbol;
        }
        self.grid.synthesise(&self.spectrum, &mut self.values);
        for ((force, z), kappa) in force.iter_mut().zip(&self.values).zip(at.at_nodes(0)) {
            *force = kappa * (z - by_length);
        }
        let scale = -1.0 / at.length().powi(2);
        let laplacian = self.derivative.minus_laplacian();
        for ((value, p), symbol) in self.spectrum.iter_mut().zip(gradient).zip(laplacian) {
            *value = p * (scale * symbol);
        }
        self.grid.synthesise(&self.spectrum, &mut self.values);
        for (force, bend) in force.iter_mut().zip(&self.values) {
            *force += bend;
        }
    }

    /// Rates of the fields per unit parameter as spectra, one per field, under the normal velocity `v`.
    /// Returns the rate of the length.
    pub fn rates(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        let modes = self.grid.modes();
        let length = at.length();
        for ((stretch, kappa), v) in self.product.iter_mut().zip(at.at_nodes(0)).zip(v) {
            *stretch = length * kappa * v;
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        let length_rate = self.spectrum[0].re;
        // D₋W = −stretch + mean, with D₋ = −conj(D₊).
        for (w, symbol) in self.spectrum.iter_mut().zip(self.derivative.inverse_to_flux()) {
            *w *= symbol.conj();
        }
        self.grid.synthesise(&self.spectrum, &mut self.tangential);
        for field in 0..self.layout.fields() {
            for ((flux, phi), w) in
                self.product.iter_mut().zip(at.at_flux_points(field)).zip(&self.tangential)
            {
                *flux = phi * w;
            }
            let rate = &mut rates[field * modes..(field + 1) * modes];
            self.grid.transform(&self.product, rate);
            for (rate, symbol) in rate.iter_mut().zip(self.derivative.to_flux()) {
                *rate *= -symbol.conj();
            }
        }
        self.grid.transform(v, &mut self.spectrum);
        let scale = 1.0 / length;
        let laplacian = self.derivative.minus_laplacian();
        for ((rate, v), symbol) in rates.iter_mut().zip(&self.spectrum).zip(laplacian) {
            *rate += v * (scale * symbol);
        }
        length_rate
    }

    /// Tangential velocity W at the nodes for the normal velocity `v` (by the Fourier derivative in every
    /// family: it places the curve, it does not enter the energy).
    pub fn tangential_velocity(&mut self, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        let length = at.length();
        for ((stretch, kappa), v) in self.product.iter_mut().zip(at.at_nodes(0)).zip(v) {
            *stretch = -length * kappa * v;
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        self.spectrum[0] = Complex64::default();
        for mode in 1..self.grid.modes() {
            self.spectrum[mode] /= Complex64::new(0.0, self.grid.wave_number(mode));
        }
        if let Some(sawtooth) = self.grid.sawtooth_mode() {
            self.spectrum[sawtooth] = Complex64::default();
        }
        self.grid.synthesise(&self.spectrum, w);
    }
}
