//! What gauges work with on one grid.

use bytemuck::{cast_slice, cast_slice_mut};

use crate::flow::curve_fields::CurveFields;
use crate::geometry::vectors::{
    add_product, add_scaled, apply_symbol, multiply_by, multiply_by_conjugate, multiply_into,
};
use crate::geometry::{Complex64, Layout, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// Grid, derivative and scratch.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Shape of the states.
    pub layout: Layout,
    /// The grid.
    pub grid: PeriodicGrid,
    /// The derivative with its grading.
    pub derivative: Derivative,
    /// −`Δ_s` without its length; none if the nodes are uniform.
    pub graded: Option<GradedLaplacian>,
    /// Scratch: one value per node.
    pub values: Vec<f64>,
    /// Scratch: one value per node.
    pub product: Vec<f64>,
    /// Scratch: the values of W at the flux points.
    pub tangential: Vec<f64>,
    /// Scratch: the rate of the length that goes with them.
    pub length_rate: f64,
    /// Scratch: one spectrum.
    pub spectrum: Vec<Complex64>,
}

impl Workspace {
    /// Room for the states of `layout`.
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
            tangential: field,
            length_rate: 0.0,
            spectrum: vec![Complex64::default(); grid.modes()],
        }
    }

    /// ∂_s(φW) of each field φ into `rates`, W the values of `tangential` at the flux points: D₋(φW), D₋ = −conj(D₊).
    pub fn transport(&mut self, at: &CurveFields, rates: &mut [Complex64]) {
        for field in 0..self.layout.fields() {
            multiply_into(&mut self.product, at.at_flux_points(field), &self.tangential);
            let rate = &mut rates[self.layout.spectrum(field)];
            self.grid.transform(&self.product, rate);
            multiply_by_conjugate(rate, -1.0, self.derivative.to_flux());
        }
    }

    /// Σ φ ∂_s p over the fields, at the flux points, into `product`: minus the transpose of [`Workspace::transport`].
    pub fn transport_transposed(&mut self, at: &CurveFields, gradient: &[Complex64]) {
        for field in 0..self.layout.fields() {
            let p = &gradient[self.layout.spectrum(field)];
            apply_symbol(&mut self.spectrum, p, self.derivative.to_flux());
            self.grid.synthesise(&self.spectrum, &mut self.values);
            let phi = at.at_flux_points(field);
            if field == 0 {
                multiply_into(&mut self.product, phi, &self.values);
            } else {
                add_product(&mut self.product, phi, &self.values);
            }
        }
    }

    /// ∂_s p of each field at the flux points, into `slopes`: one value per node for each.
    pub fn set_slopes(&mut self, gradient: &[Complex64], slopes: &mut [f64]) {
        for field in 0..self.layout.fields() {
            apply_symbol(
                &mut self.spectrum,
                &gradient[self.layout.spectrum(field)],
                self.derivative.to_flux(),
            );
            self.grid.synthesise(&self.spectrum, &mut slopes[self.layout.field(field)]);
        }
    }

    /// Σ δφ ∂_s p over the fields, at the flux points, into `product`, of the nodal `motion` δφ.
    pub fn pair_with_slopes(&mut self, motion: &[f64], slopes: &[f64]) {
        let nodes = self.layout.nodes();
        self.product.fill(0.0);
        for (motion, slopes) in motion.chunks_exact(nodes).zip(slopes.chunks_exact(nodes)) {
            if self.interpolate(motion) {
                add_product(&mut self.product, &self.values, slopes);
            } else {
                add_product(&mut self.product, motion, slopes);
            }
        }
    }

    /// Adds ∂_s(φW) to `rate`, of the nodal `field` φ and the values of W at the flux points.
    pub fn add_transport(&mut self, field: &[f64], tangential: &[f64], rate: &mut [Complex64]) {
        let at_flux_points = if self.interpolate(field) { &self.values } else { field };
        multiply_into(&mut self.product, at_flux_points, tangential);
        self.grid.transform(&self.product, &mut self.spectrum);
        multiply_by_conjugate(&mut self.spectrum, -1.0, self.derivative.to_flux());
        add_scaled(cast_slice_mut(rate), 1.0, cast_slice(&self.spectrum));
    }

    /// The nodal `field` at the flux points, into `values`; false where these are the nodes.
    fn interpolate(&mut self, field: &[f64]) -> bool {
        let Some(interpolation) = self.derivative.interpolation() else { return false };
        self.grid.transform(field, &mut self.spectrum);
        multiply_by(&mut self.spectrum, interpolation);
        self.grid.synthesise(&self.spectrum, &mut self.values);
        true
    }

    /// Z of D₊Z = `product` less its mean, into `values`; with mean zero.
    pub fn integrate_product(&mut self) {
        self.grid.transform(&self.product, &mut self.spectrum);
        multiply_by(&mut self.spectrum, self.derivative.inverse_to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.values);
    }
}
