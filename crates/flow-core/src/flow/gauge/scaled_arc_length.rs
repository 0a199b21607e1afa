//! Scaled arc length: ∂_sW = −|Γ|κV + ∂_t|Γ|, ∫W dσ = 0, so that the metric stays |Γ|. See `THEORY.md`, eqs. (F1)–(F3).

use super::{Gauge, MetricRole, Workspace};
use crate::flow::CurveFields;
use crate::geometry::Complex64;
use crate::geometry::vectors::{multiply_by_conjugate, multiply_into, scale, shift_into};

/// ∂_sW = −|Γ|κV + ∂_t|Γ| with ∫W dσ = 0: the nodes stay at equal distances. See `THEORY.md`, eqs. (F1)–(F3).
#[derive(Clone, Copy, Debug, Default)]
pub struct ScaledArcLength;

impl Gauge for ScaledArcLength {
    fn metric(&self) -> MetricRole {
        MetricRole::Uniform
    }

    fn rates(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        self.set_tangential(work, at, v);
        work.transport(at, rates);
        work.length_rate
    }

    fn rates_at_hand(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        v: &[f64],
        rates: &mut [Complex64],
    ) -> f64 {
        if !flux_points_are_nodes(work) {
            return self.rates(work, at, v, rates);
        }
        work.transport(at, rates);
        work.length_rate
    }

    /// Z − ⟨Z⟩ − π of (F3): what a stretched piece loses, minus its tension.
    fn stretching(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        gradient: &[Complex64],
        by_length: f64,
        out: &mut [f64],
    ) {
        work.transport_transposed(at, gradient);
        work.integrate_product();
        shift_into(out, -by_length, &work.values);
    }

    fn change_of_stretching(&self, work: &mut Workspace, _: &CurveFields, out: &mut [f64]) -> bool {
        work.integrate_product();
        out.copy_from_slice(&work.values);
        true
    }

    fn set_tangential(&self, work: &mut Workspace, at: &CurveFields, v: &[f64]) -> bool {
        let length = at.length();
        multiply_into(&mut work.product, at.at_nodes(0), v);
        work.grid.transform(&work.product, &mut work.spectrum);
        work.length_rate = length * work.spectrum[0].re;
        // D₋W = −|Γ|κV + mean, with D₋ = −conj(D₊).
        multiply_by_conjugate(&mut work.spectrum, length, work.derivative.inverse_to_flux());
        work.grid.synthesise(&work.spectrum, &mut work.tangential);
        true
    }

    fn tangential_velocity(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        if flux_points_are_nodes(work) {
            self.set_tangential(work, at, v);
            return w.copy_from_slice(&work.tangential);
        }
        multiply_into(&mut work.product, at.at_nodes(0), v);
        scale(&mut work.product, -at.length());
        work.grid.transform(&work.product, &mut work.spectrum);
        work.grid.integrate(&mut work.spectrum);
        work.grid.synthesise(&work.spectrum, w);
    }
}

/// Whether D₊ is the derivative at the nodes, that of Fourier.
fn flux_points_are_nodes(work: &Workspace) -> bool {
    work.derivative.interpolation().is_none()
}
