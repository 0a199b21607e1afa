//! Gauges: the rule for the tangential velocity W, linear in the normal one, with its exact transpose. See `THEORY.md`, eqs. (F1)–(F3),
//! (F17) and (F19).
//!
//! A new one is a file here and, for scenes, a name and a line in `run/scene/gauge.rs`. Everything else asks for its
//! [`MetricRole`].

mod co_moving;
mod graded;
mod scaled_arc_length;
mod workspace;

use std::fmt::Debug;

use super::curve_fields::CurveFields;
use crate::geometry::Complex64;

pub use co_moving::CoMoving;
pub use graded::Graded;
pub use scaled_arc_length::ScaledArcLength;
pub use workspace::Workspace;

/// What the metric g is in a gauge: all that states, energies, mobilities and preconditioners need to know of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MetricRole {
    /// g = |Γ|: the nodes are at equal distances.
    Uniform,
    /// g = |Γ|w with a fixed grading w.
    Graded,
    /// g is a field of the state ([`crate::geometry::Layout::with_metric`]).
    Field,
}

/// Which tangential velocity W goes with a normal one V, linear in it, and the exact transpose of that. See `THEORY.md`, eqs. (F1)–(F3),
/// (F17) and (F19).
///
/// A gauge holds no state: one may serve any number of flows. The part of the curvature's rate that no gauge changes,
/// `−Δ_s`V, and its transpose are not its business.
pub trait Gauge: Debug + Send + Sync {
    /// What the metric is.
    fn metric(&self) -> MetricRole;

    /// Rates of the fields per unit parameter under the normal velocity `v` and its W, but for −`Δ_s`V: ∂_s(φW) for each
    /// field φ, and g(κV + ∇_sW) for a metric that is a field. Returns the rate of the length.
    ///
    /// # Shapes
    /// `v`: one value per node. `rates`: a spectrum for each field of the state, overwritten.
    fn rates(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64;

    /// As [`Gauge::rates`], right after [`Gauge::tangential_velocity`] at the same state for the same `v`: a gauge may go on from
    /// what is in `work` then.
    fn rates_at_hand(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        v: &[f64],
        rates: &mut [Complex64],
    ) -> f64 {
        self.rates(work, at, v, rates)
    }

    /// The transpose: what the energy loses where a piece of the curve is stretched, per length, for derivatives `gradient` by
    /// the fields (spectra) and `by_length` by the length. With V = v: |Γ|⟨w κ out v⟩ is minus the pairing of the gradient
    /// and [`Gauge::rates`].
    ///
    /// # Shapes
    /// `gradient`: a spectrum for each field of the state. `out`: one value per node, overwritten.
    fn stretching(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        gradient: &[Complex64],
        by_length: f64,
        out: &mut [f64],
    );

    /// What a motion δφ of the fields does to [`Gauge::stretching`] at the same gradient, but for a constant, from
    /// `work.product` = Σ δφ ∂_s p at the flux points; false where W does not depend on the fields.
    ///
    /// # Shapes
    /// `out`: one value per node, overwritten.
    fn change_of_stretching(&self, _work: &mut Workspace, _at: &CurveFields, _out: &mut [f64]) -> bool {
        false
    }

    /// W at the flux points into `work.tangential`, and the rate of the length; false where nodes are material.
    fn set_tangential(&self, _work: &mut Workspace, _at: &CurveFields, _v: &[f64]) -> bool {
        false
    }

    /// W at the nodes (by the Fourier derivative in every family: it places the curve, it does not enter the energy).
    ///
    /// # Shapes
    /// `v` and `w`: one value per node.
    fn tangential_velocity(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], w: &mut [f64]);
}
