//! Graded arc length: ∂_sW = w(−|Γ|κV + ∂_t|Γ|), ∫W dσ = 0, so that the metric stays |Γ|w. See `THEORY.md`, eq. (F3), second paragraph.

use super::{Gauge, MetricRole, Workspace};
use crate::flow::CurveFields;
use crate::geometry::vectors::{
    add_scaled, mean, mean_of_product, multiply, multiply_by_conjugate, multiply_into, scale,
};
use crate::geometry::{Complex64, Grading};

/// ∂_sW = w(−|Γ|κV + ∂_t|Γ|) with ∫W dσ = 0 and the grading w: see `THEORY.md`, eqs. (F3) and (F17).
///
/// The nodes keep their fractions of the arc length, those of a grading: without one there is [`ScaledArcLength`](super::ScaledArcLength).
#[derive(Clone, Copy, Debug, Default)]
pub struct Graded;

impl Gauge for Graded {
    fn metric(&self) -> MetricRole {
        MetricRole::Graded
    }

    fn rates(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        self.set_tangential(work, at, v);
        work.transport(at, rates);
        work.length_rate
    }

    /// Z − ⟨wZ⟩ − π of (F3): what a stretched piece loses, minus its tension.
    fn stretching(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        gradient: &[Complex64],
        by_length: f64,
        out: &mut [f64],
    ) {
        let grading = grading(at);
        work.transport_transposed(at, gradient);
        integrate_product(work, grading);
        let by_length = by_length + mean_of_product(grading.weight(), &work.values);
        for (out, z) in out.iter_mut().zip(&work.values) {
            *out = z - by_length;
        }
    }

    fn change_of_stretching(&self, work: &mut Workspace, at: &CurveFields, out: &mut [f64]) -> bool {
        integrate_product(work, grading(at));
        out.copy_from_slice(&work.values);
        true
    }

    fn set_tangential(&self, work: &mut Workspace, at: &CurveFields, v: &[f64]) -> bool {
        let grading = grading(at);
        let length = at.length();
        multiply_into(&mut work.product, at.at_nodes(0), v);
        let stretch = mean_of_product(grading.weight(), &work.product);
        work.length_rate = length * stretch;
        work.product.iter_mut().for_each(|product| *product -= stretch);
        multiply(&mut work.product, grading.weight());
        work.grid.transform(&work.product, &mut work.spectrum);
        // D₋W = w(−|Γ|κV + mean), with D₋ = −conj(D₊).
        multiply_by_conjugate(&mut work.spectrum, length, work.derivative.inverse_to_flux());
        work.grid.synthesise(&work.spectrum, &mut work.tangential);
        let mean = mean_of_product(grading.at_midpoints(), &work.tangential) / grading.midpoint_mean();
        work.tangential.iter_mut().for_each(|w| *w -= mean);
        true
    }

    fn tangential_velocity(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        let grading = grading(at);
        multiply_into(&mut work.product, at.at_nodes(0), v);
        scale(&mut work.product, -at.length());
        let mean = mean_of_product(grading.weight(), &work.product);
        work.product.iter_mut().for_each(|stretch| *stretch -= mean);
        multiply(&mut work.product, grading.weight());
        work.grid.transform(&work.product, &mut work.spectrum);
        work.grid.integrate(&mut work.spectrum);
        work.grid.synthesise(&work.spectrum, w);
        let mean = mean_of_product(grading.weight(), w);
        for w in w {
            *w -= mean;
        }
    }
}

/// [`Workspace::integrate_product`] where W has mean zero over the curve, not over the flux points.
fn integrate_product(work: &mut Workspace, grading: &Grading) {
    let excess = -mean(&work.product) / grading.midpoint_mean();
    add_scaled(&mut work.product, excess, grading.at_midpoints());
    work.integrate_product();
}

/// The grading of the nodes.
///
/// # Panics
/// If they are uniform: a flow map on such nodes has another gauge ([`FlowMap::in_gauge`](crate::flow::FlowMap::in_gauge)).
fn grading(at: &CurveFields) -> &Grading {
    at.grading().expect("the nodes are graded")
}
