//! The flow map A: normal velocity ↦ rates of the state, gauge included, and its exact transpose. See `THEORY.md`, eqs. (F1)–(F3).

use std::sync::Arc;

use bytemuck::{cast_slice, cast_slice_mut};

use super::curve_fields::{CurveFields, check_nodes};
use super::gauge::{CoMoving, Gauge, Graded, MetricRole, ScaledArcLength, Workspace};
use super::graded_energy::mean_product;
use crate::geometry::vectors::{
    add_product, add_real_symbol, add_scaled, apply_real_symbol, multiply, multiply_into,
};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// The flow map A of one gauge on one grid, V ↦ the rates of the state, and its exact transpose Aᵀ, the gradient ↦ the force on V; holds
/// all scratch. See `THEORY.md`, eqs. (F2) and (F3).
///
/// # Shapes
/// Velocities, forces and stretchings: one value per node. Gradients and rates: a spectrum for each field of the state, those of
/// the curvature and the densities first, then that of the metric if it is a field.
/// # Units
/// Rates are those of K = κg and m = ρg (and g), per unit parameter and time; a velocity is a length per time, and the force on it
/// an energy per length squared: the energy lost per normal displacement and arc length.
#[derive(Clone, Debug)]
pub struct FlowMap {
    work: Workspace,
    gauge: Arc<dyn Gauge>,
    image: Vec<Complex64>,
    stretching: Vec<f64>,
    /// Whether nothing has been computed since the last tangential velocity.
    at_hand: bool,
}

impl FlowMap {
    /// The flow map for states of `layout` that leaves the nodes where they are on the curve: at their fractions of the arc
    /// length, or as material points if the metric is a field.
    ///
    /// # Panics
    /// As [`FlowMap::in_gauge`].
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let gauge: Arc<dyn Gauge> =
            if layout.metric().is_some() { Arc::new(CoMoving) } else { Arc::new(Graded) };
        Self::in_gauge(gauge, layout, grid, derivative)
    }

    /// The flow map in `gauge`; in [`ScaledArcLength`] where a grading may be and there is none.
    ///
    /// # Panics
    /// If the metric is a field of the gauge and none of `layout`, or the other way round, if nodes are graded whose metric
    /// is uniform, or if states, grid and derivative have different numbers of nodes.
    #[must_use]
    pub fn in_gauge(
        gauge: Arc<dyn Gauge>,
        layout: Layout,
        grid: &PeriodicGrid,
        derivative: &Derivative,
    ) -> Self {
        let role = gauge.metric();
        check_nodes(layout, grid, derivative);
        assert_eq!(layout.metric().is_some(), role == MetricRole::Field, "the metric of {gauge:?}");
        assert!(derivative.grading().is_none() || role != MetricRole::Uniform, "graded nodes in {gauge:?}");
        assert!(derivative.grading().is_some() || role != MetricRole::Field, "no metric for {gauge:?}");
        let equal = role == MetricRole::Graded && derivative.grading().is_none();
        let gauge = if equal { Arc::new(ScaledArcLength) } else { gauge };
        let image = vec![Complex64::default(); grid.modes()];
        let stretching = vec![0.0; layout.nodes()];
        Self { work: Workspace::new(layout, grid, derivative), gauge, image, stretching, at_hand: false }
    }

    /// Shape of the states.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.work.layout
    }

    /// The derivative, for others who work on the same nodes.
    #[must_use]
    pub fn derivative(&self) -> &Derivative {
        &self.work.derivative
    }

    /// The grid, with its scratch.
    pub fn grid_mut(&mut self) -> &mut PeriodicGrid {
        &mut self.work.grid
    }

    /// Both at once.
    pub fn grid_and_derivative(&mut self) -> (&mut PeriodicGrid, &Derivative) {
        (&mut self.work.grid, &self.work.derivative)
    }

    /// The grading of the nodes; none if they are uniform.
    #[must_use]
    pub fn grading(&self) -> Option<&Arc<Grading>> {
        self.work.derivative.grading()
    }

    /// −`Δ_s` without its length, on graded nodes.
    pub fn graded_laplacian(&mut self) -> Option<&mut GradedLaplacian> {
        self.work.graded.as_mut()
    }

    /// How often a mode stands in the full spectrum.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        self.work.grid.multiplicity(mode)
    }

    /// Mean of the product of two nodal fields, by their spectra.
    #[must_use]
    pub fn mean_product(&self, a: &[Complex64], b: &[Complex64]) -> f64 {
        mean_product(&self.work.grid, a, b)
    }

    /// Force f = −Aᵀ∇𝓕 of a gradient given by the spectra `gradient` (one per field, per unit length) and
    /// `by_length` = ∂𝓕/∂|Γ| at fixed K and m. f is a density in L²(dσ). Where the metric is a field, the
    /// derivative by it is the last spectrum, and that by its mean `by_length`.
    pub fn force(&mut self, at: &CurveFields, gradient: &[Complex64], by_length: f64, force: &mut [f64]) {
        let mut stretching = std::mem::take(&mut self.stretching);
        self.stretching(at, gradient, by_length, &mut stretching);
        self.complete_force(at, gradient, &stretching, force);
        self.stretching = stretching;
    }

    /// The force of a gradient whose [`FlowMap::stretching`] is known.
    pub fn complete_force(
        &mut self,
        at: &CurveFields,
        gradient: &[Complex64],
        stretching: &[f64],
        force: &mut [f64],
    ) {
        multiply_into(force, stretching, at.at_nodes(0));
        self.at_hand = false;
        let Workspace { grid, derivative, graded, values, spectrum, .. } = &mut self.work;
        let p = &gradient[..grid.modes()];
        let scale = -1.0 / at.length().powi(2);
        if let Some((graded, grading)) = graded.as_mut().zip(at.grading()) {
            graded.apply(grading, p, spectrum);
            grid.synthesise(spectrum, values);
            multiply(values, grading.inverse());
            add_scaled(force, scale, values);
            return;
        }
        apply_real_symbol(spectrum, scale, p, derivative.minus_laplacian());
        grid.synthesise(spectrum, values);
        add_scaled(force, 1.0, values);
    }

    /// The part of the force by curvature ([`Gauge::stretching`]), for a gradient as [`FlowMap::force`] takes it: what the
    /// energy loses where a piece of the curve is stretched, minus its tension.
    pub fn stretching(&mut self, at: &CurveFields, gradient: &[Complex64], by_length: f64, out: &mut [f64]) {
        self.at_hand = false;
        self.gauge.stretching(&mut self.work, at, gradient, by_length, out);
    }

    /// Derivatives of `gradient` along the curve, for [`FlowMap::add_change_of_stretching`]: one value per node for each field.
    pub fn set_slopes(&mut self, gradient: &[Complex64], slopes: &mut [f64]) {
        self.at_hand = false;
        self.work.set_slopes(gradient, slopes);
    }

    /// Adds to `force` what the nodal `motion` of the fields does to it through the stretching, at the gradient with these `slopes`; but
    /// for a multiple of κ.
    pub fn add_change_of_stretching(
        &mut self,
        at: &CurveFields,
        motion: &[f64],
        slopes: &[f64],
        force: &mut [f64],
    ) {
        self.at_hand = false;
        self.work.pair_with_slopes(motion, slopes);
        if self.gauge.change_of_stretching(&mut self.work, at, &mut self.stretching) {
            add_product(force, &self.stretching, at.at_nodes(0));
        }
    }

    /// Rates of the fields per unit parameter as spectra, one per field, under the normal velocity `v`.
    /// Returns the rate of the length.
    pub fn rates(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        self.at_hand = false;
        let length_rate = self.gauge.rates(&mut self.work, at, v, rates);
        self.complete_rates(at, v, rates);
        length_rate
    }

    /// As [`FlowMap::rates`], for the state and the `v` of the last [`FlowMap::tangential_velocity`] if that was the last call.
    pub fn rates_at_hand(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        if !std::mem::take(&mut self.at_hand) {
            return self.rates(at, v, rates);
        }
        let length_rate = self.gauge.rates_at_hand(&mut self.work, at, v, rates);
        self.complete_rates(at, v, rates);
        length_rate
    }

    /// W at the flux points for the normal velocity `v`; zero where nodes are material.
    pub fn set_sliding(&mut self, at: &CurveFields, v: &[f64], sliding: &mut [f64]) {
        self.at_hand = false;
        if self.gauge.set_tangential(&mut self.work, at, v) {
            sliding.copy_from_slice(&self.work.tangential);
        } else {
            sliding.fill(0.0);
        }
    }

    /// Adds ∂_s(φW) to the spectrum `rate`, of a nodal `field` φ and the W of [`FlowMap::set_sliding`].
    pub fn add_transport(&mut self, field: &[f64], sliding: &[f64], rate: &mut [Complex64]) {
        self.at_hand = false;
        self.work.add_transport(field, sliding, rate);
    }

    /// Adds −`Δ_s`V to the rate of the curvature.
    fn complete_rates(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) {
        let Workspace { grid, derivative, graded, spectrum, .. } = &mut self.work;
        let turning = &mut rates[..grid.modes()];
        grid.transform(v, spectrum);
        let scale = 1.0 / at.length();
        if let Some((graded, grading)) = graded.as_mut().zip(at.grading()) {
            graded.apply(grading, spectrum, &mut self.image);
            add_scaled(cast_slice_mut(turning), scale, cast_slice(&self.image));
        } else {
            add_real_symbol(turning, scale, spectrum, derivative.minus_laplacian());
        }
    }

    /// Tangential velocity W at the nodes for the normal velocity `v`.
    pub fn tangential_velocity(&mut self, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        self.gauge.tangential_velocity(&mut self.work, at, v, w);
        self.at_hand = true;
    }
}
