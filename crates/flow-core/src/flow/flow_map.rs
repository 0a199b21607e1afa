//! The flow map A: normal velocity ↦ rates of the state, gauge included, and its exact transpose.
//!
//! Scaled arc-length gauge: ∂_sW = w(−|Γ|κV + ∂_t|Γ|), so that the metric stays |Γ|w. See `THEORY.md`, eqs. (F1)–(F3).

use std::sync::Arc;

use bytemuck::{cast_slice, cast_slice_mut};

use super::curve_fields::CurveFields;
use crate::geometry::vectors::{
    add_product, add_real_symbol, add_scaled, apply_real_symbol, apply_symbol, mean, mean_of_product,
    multiply, multiply_by, multiply_by_conjugate, multiply_into, scale,
};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// Applies A and Aᵀ on one grid; holds all scratch.
#[derive(Clone, Debug)]
pub struct FlowMap {
    pub(super) layout: Layout,
    pub(super) grid: PeriodicGrid,
    derivative: Derivative,
    pub(super) graded: Option<GradedLaplacian>,
    pub(super) values: Vec<f64>,
    pub(super) product: Vec<f64>,
    pub(super) spectrum: Vec<Complex64>,
    pub(super) image: Vec<Complex64>,
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
            graded: GradedLaplacian::of(grid, derivative),
            values: field.clone(),
            product: field.clone(),
            spectrum: vec![Complex64::default(); grid.modes()],
            image: vec![Complex64::default(); grid.modes()],
            tangential: field,
        }
    }

    /// Grid and derivative, for others who work on the same nodes.
    pub fn grid_and_derivative(&mut self) -> (&mut PeriodicGrid, &Derivative) {
        (&mut self.grid, &self.derivative)
    }

    /// The grading of the nodes; none if they are uniform.
    #[must_use]
    pub fn grading(&self) -> Option<&Arc<Grading>> {
        self.derivative.grading()
    }

    /// −`Δ_s` without its length, on graded nodes.
    pub fn graded_laplacian(&mut self) -> Option<&mut GradedLaplacian> {
        self.graded.as_mut()
    }

    /// How often a mode stands in the full spectrum.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        self.grid.multiplicity(mode)
    }

    /// Force f = −Aᵀ∇𝓕 of a gradient given by the spectra `gradient` (one per field, per unit length) and
    /// `by_length` = ∂𝓕/∂|Γ| at fixed K and m. f is a density in L²(dσ). Where the metric is a field, the
    /// derivative by it is the last spectrum, and that by its mean `by_length`.
    pub fn force(&mut self, at: &CurveFields, gradient: &[Complex64], by_length: f64, force: &mut [f64]) {
        self.stretching(at, gradient, by_length, force);
        multiply(force, at.at_nodes(0));
        if at.moving_metric().is_some() {
            return self.add_co_moving_force(at, gradient, force);
        }
        let modes = self.grid.modes();
        let scale = -1.0 / at.length().powi(2);
        if let Some(graded) = &mut self.graded {
            graded.apply(&gradient[..modes], &mut self.spectrum);
            self.grid.synthesise(&self.spectrum, &mut self.values);
            multiply(&mut self.values, graded.grading().inverse());
            add_scaled(force, scale, &self.values);
            return;
        }
        apply_real_symbol(&mut self.spectrum, scale, gradient, self.derivative.minus_laplacian());
        self.grid.synthesise(&self.spectrum, &mut self.values);
        add_scaled(force, 1.0, &self.values);
    }

    /// Z − ⟨wZ⟩ − π of (F3), the part of the force by curvature, for a gradient as [`FlowMap::force`] takes it: what the
    /// energy loses where a piece of the curve is stretched, minus its tension.
    pub fn stretching(&mut self, at: &CurveFields, gradient: &[Complex64], by_length: f64, out: &mut [f64]) {
        if at.moving_metric().is_some() {
            return self.co_moving_stretching(gradient, by_length, out);
        }
        let modes = self.grid.modes();
        // z = Σ φ ∂_s p over the fields, at the flux points.
        for field in 0..self.layout.fields() {
            let p = &gradient[field * modes..(field + 1) * modes];
            apply_symbol(&mut self.spectrum, p, self.derivative.to_flux());
            self.grid.synthesise(&self.spectrum, &mut self.values);
            let phi = at.at_flux_points(field);
            if field == 0 {
                multiply_into(&mut self.product, phi, &self.values);
            } else {
                add_product(&mut self.product, phi, &self.values);
            }
        }
        if let Some(graded) = &self.graded {
            // W has mean zero over the curve, not over the flux points.
            let weight = graded.grading().at_midpoints();
            let excess = -mean(&self.product) / graded.grading().midpoint_mean();
            add_scaled(&mut self.product, excess, weight);
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        multiply_by(&mut self.spectrum, self.derivative.inverse_to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.values);
        let by_length = match &self.graded {
            None => by_length,
            Some(graded) => by_length + mean_of_product(graded.grading().weight(), &self.values),
        };
        for (out, z) in out.iter_mut().zip(&self.values) {
            *out = z - by_length;
        }
    }

    /// Rates of the fields per unit parameter as spectra, one per field, under the normal velocity `v`.
    /// Returns the rate of the length.
    pub fn rates(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        if at.moving_metric().is_some() {
            return self.co_moving_rates(at, v, rates);
        }
        let modes = self.grid.modes();
        let length = at.length();
        multiply_into(&mut self.product, at.at_nodes(0), v);
        let mut length_rate = 0.0;
        if let Some(graded) = &self.graded {
            let weight = graded.grading().weight();
            let stretch = mean_of_product(weight, &self.product);
            length_rate = length * stretch;
            self.product.iter_mut().for_each(|product| *product -= stretch);
            multiply(&mut self.product, weight);
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        if self.graded.is_none() {
            length_rate = length * self.spectrum[0].re;
        }
        // D₋W = −|Γ|wκV + mean, with D₋ = −conj(D₊).
        multiply_by_conjugate(&mut self.spectrum, length, self.derivative.inverse_to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.tangential);
        if let Some(graded) = &self.graded {
            let weight = graded.grading().at_midpoints();
            let mean = mean_of_product(weight, &self.tangential) / graded.grading().midpoint_mean();
            self.tangential.iter_mut().for_each(|w| *w -= mean);
        }
        for field in 0..self.layout.fields() {
            multiply_into(&mut self.product, at.at_flux_points(field), &self.tangential);
            let rate = &mut rates[field * modes..(field + 1) * modes];
            self.grid.transform(&self.product, rate);
            multiply_by_conjugate(rate, -1.0, self.derivative.to_flux());
        }
        self.grid.transform(v, &mut self.spectrum);
        let scale = 1.0 / length;
        if let Some(graded) = &mut self.graded {
            graded.apply(&self.spectrum, &mut self.image);
            add_scaled(cast_slice_mut(&mut rates[..modes]), scale, cast_slice(&self.image));
        } else {
            add_real_symbol(&mut rates[..modes], scale, &self.spectrum, self.derivative.minus_laplacian());
        }
        length_rate
    }

    /// Tangential velocity W at the nodes for the normal velocity `v` (by the Fourier derivative in every
    /// family: it places the curve, it does not enter the energy).
    pub fn tangential_velocity(&mut self, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        if at.moving_metric().is_some() {
            return w.fill(0.0);
        }
        multiply_into(&mut self.product, at.at_nodes(0), v);
        scale(&mut self.product, -at.length());
        if let Some(graded) = &self.graded {
            let weight = graded.grading().weight();
            let mean = mean_of_product(weight, &self.product);
            self.product.iter_mut().for_each(|stretch| *stretch -= mean);
            multiply(&mut self.product, weight);
        }
        self.grid.transform(&self.product, &mut self.spectrum);
        self.grid.integrate(&mut self.spectrum);
        self.grid.synthesise(&self.spectrum, w);
        if let Some(graded) = &self.graded {
            let mean = mean_of_product(graded.grading().weight(), w);
            for w in w {
                *w -= mean;
            }
        }
    }
}
