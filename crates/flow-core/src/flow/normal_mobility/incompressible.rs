//! Local length held: 𝓘 = Id − κH⁻¹κ with H = −`Δ_s` + κ². See `THEORY.md`, eq. (F8).

use super::{Kept, MobilityError, NormalMobility};
use crate::flow::CurveFields;
use crate::operators::{CurveHelmholtz, Derivative};

/// Every piece of the curve keeps its length: V = 𝓘f with 𝓘 = Id − κH⁻¹κ, H = −`Δ_s` + κ². See `THEORY.md`, eq. (F8).
///
/// The kernel of 𝓘 is spanned by κ; projecting κ out before and after changes nothing but the rounding, and
/// makes the rate of the length ⟨κV⟩|Γ| zero up to it.
#[derive(Clone, Debug)]
pub struct Incompressible {
    helmholtz: CurveHelmholtz,
    mean_square: f64,
    right: Vec<f64>,
    solution: Vec<f64>,
}

impl Incompressible {
    /// Room for one state of `nodes` ≥ [`crate::operators::Helmholtz::FEWEST_NODES`] nodes
    /// in the metric of `derivative`.
    #[must_use]
    pub fn new(derivative: &Derivative, nodes: usize) -> Self {
        Self {
            helmholtz: CurveHelmholtz::new(derivative, nodes),
            mean_square: 1.0,
            right: vec![0.0; nodes],
            solution: vec![0.0; nodes],
        }
    }

    /// Component of `values` along κ.
    fn along(&self, at: &CurveFields, values: &[f64]) -> f64 {
        at.mean_of_product(at.at_nodes(0), values) / self.mean_square
    }

    /// Takes the component along κ out of `values`.
    pub(super) fn project(&self, at: &CurveFields, values: &mut [f64]) {
        let factor = self.along(at, values);
        for (value, kappa) in values.iter_mut().zip(at.at_nodes(0)) {
            *value -= factor * kappa;
        }
    }
}

impl NormalMobility for Incompressible {
    fn set(&mut self, at: &CurveFields) -> Result<(), MobilityError> {
        let kappa = at.at_nodes(0);
        self.mean_square = at.mean_of_product(kappa, kappa);
        Ok(self.helmholtz.set(at.grading(), kappa, at.length())?)
    }

    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        let kappa = at.at_nodes(0);
        velocity.copy_from_slice(force);
        self.project(at, velocity);
        for ((right, kappa), f) in self.right.iter_mut().zip(kappa).zip(&*velocity) {
            *right = kappa * f;
        }
        self.helmholtz.solve(&self.right, &mut self.solution);
        for ((v, kappa), u) in velocity.iter_mut().zip(kappa).zip(&self.solution) {
            *v -= kappa * u;
        }
        self.project(at, velocity);
    }

    fn holding_tension(&mut self, at: &CurveFields, force: &[f64], tension: &mut [f64]) {
        let along = self.along(at, force);
        for ((right, kappa), f) in self.right.iter_mut().zip(at.at_nodes(0)).zip(force) {
            *right = kappa * (f - along * kappa);
        }
        self.helmholtz.solve(&self.right, tension);
        for value in tension {
            *value += along;
        }
    }

    fn symbol(&self, wave_square: f64) -> f64 {
        wave_square / (wave_square + self.mean_square)
    }

    fn keeps(&self) -> Kept {
        Kept { length: true, area: false }
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(self.clone())
    }
}
