//! From a rate of the curvature back to the motion that makes it.

use super::{Descent, GradientFlow};
use crate::flow::graded_energy::add_spectrum;
use crate::geometry::Complex64;

impl GradientFlow {
    /// Mean of the periodic antiderivative of nodal values of mean zero that starts from zero at node 0.
    pub fn mean_antiderivative(&mut self, values: &[f64]) -> f64 {
        let grid = self.descent.map.grid_mut();
        grid.transform(values, &mut self.descent.spectrum);
        grid.integrate(&mut self.descent.spectrum);
        // The integral has mean zero: less its value at node 0, the sum of its coefficients.
        let modes = self.descent.spectrum.iter().enumerate();
        -modes.map(|(mode, value)| self.descent.map.multiplicity(mode) * value.re).sum::<f64>()
    }

    /// Replaces the spectrum `turning` of a rate of K by scratch, and writes the normal velocity V that makes it to leading
    /// order, K = −|Γ|`Δ_s` V, at the frozen state.
    pub(in crate::flow) fn velocity_of_turning(&mut self, turning: &mut [Complex64], velocity: &mut [f64]) {
        let length = self.frozen.fields.length();
        for value in turning.iter_mut() {
            *value *= length;
        }
        if let Some((graded, grading)) = self.descent.map.graded_laplacian().zip(self.frozen.fields.grading())
        {
            graded.solve(grading, turning);
        } else {
            let symbols = self.descent.map.derivative().minus_laplacian().iter();
            for (value, symbol) in turning.iter_mut().zip(symbols) {
                *value = if *symbol > 0.0 { *value / *symbol } else { Complex64::default() };
            }
        }
        self.descent.map.grid_mut().synthesise(turning, velocity);
    }

    /// K = −|Γ|`Δ_s` V of the velocity with the spectrum `velocity`, to leading order, at the frozen state.
    pub(in crate::flow) fn turning_of_velocity(&mut self, velocity: &[Complex64], turning: &mut [Complex64]) {
        let length = self.frozen.fields.length();
        if let Some((graded, grading)) = self.descent.map.graded_laplacian().zip(self.frozen.fields.grading())
        {
            graded.apply(grading, velocity, turning);
        } else {
            let symbols = self.descent.map.derivative().minus_laplacian();
            for ((turning, velocity), symbol) in turning.iter_mut().zip(velocity).zip(symbols) {
                *turning = velocity * *symbol;
            }
        }
        for value in turning {
            *value /= length;
        }
    }

    /// Adds `factor` times the rates of the densities under the normal velocity V that makes the curvature of the spectral
    /// `state` its rate to leading order, K = −|Γ|`Δ_s` V, at the frozen state. Overwrites the gradient and the velocity.
    pub(in crate::flow) fn carry_densities(&mut self, state: &mut [f64], factor: f64) {
        let layout = self.spectral_layout();
        let modes = self.descent.spectrum.len();
        let (turning, densities) = layout.spectra_mut(state).split_at_mut(modes);
        let (mut spectrum, mut velocity) =
            (std::mem::take(&mut self.descent.spectrum), std::mem::take(&mut self.descent.velocity));
        spectrum.copy_from_slice(turning);
        self.velocity_of_turning(&mut spectrum, &mut velocity);
        (self.descent.spectrum, self.descent.velocity) = (spectrum, velocity);
        self.descent.map.rates(
            &self.frozen.fields,
            &self.descent.velocity,
            &mut self.descent.gradient.spectra,
        );
        self.descent.map.grid_mut().make_real(&mut self.descent.gradient.spectra);
        for (density, rate) in densities.iter_mut().zip(&self.descent.gradient.spectra[modes..]) {
            *density += rate * factor;
        }
    }

    /// Rates of the spectral state under the normal velocity alone, at the frozen state.
    pub(in crate::flow) fn motion_of(&mut self, velocity: &[f64], rates: &mut [f64]) {
        let layout = self.spectral_layout();
        let spectra = layout.spectra_mut(rates);
        let length_rate = self.descent.map.rates(&self.frozen.fields, velocity, spectra);
        self.descent.map.grid_mut().make_real(spectra);
        rates[layout.length_index()] = length_rate;
    }

    /// Adds `factor` times the rate of the density `field` by the gradient at hand to the spectrum `rates`, at the frozen state.
    pub(in crate::flow) fn add_density_rate(&mut self, field: usize, factor: f64, rates: &mut [Complex64]) {
        let Descent { layout, density_mobilities, gradient, spectrum, .. } = &mut self.descent;
        let at = &self.frozen.fields;
        density_mobilities[field - 1].apply(at, &gradient.spectra[layout.spectrum(field)], spectrum);
        add_spectrum(rates, -factor * at.length(), spectrum);
    }
}
