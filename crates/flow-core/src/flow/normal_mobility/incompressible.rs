//! Local length held: 𝓘 = Id − κH⁻¹κ with H = −`Δ_s` + κ². See `THEORY.md`, eq. (F8).

use super::{Kept, MobilityError, NormalMobility};
use crate::flow::CurveFields;
use crate::geometry::vectors::mean_of_product;
use crate::operators::{DerivativeFamily, Helmholtz};

/// V = 𝓘f. The kernel of 𝓘 is spanned by κ; projecting κ out before and after changes nothing but the rounding, and
/// makes the rate of the length ⟨κV⟩|Γ| zero up to it.
#[derive(Clone, Debug)]
pub struct Incompressible {
    helmholtz: Helmholtz,
    mean_square: f64,
    right: Vec<f64>,
    solution: Vec<f64>,
}

impl Incompressible {
    /// Room for one state of `nodes` ≥ [`Helmholtz::FEWEST_NODES`] nodes.
    #[must_use]
    pub fn new(family: DerivativeFamily, nodes: usize) -> Self {
        Self {
            helmholtz: Helmholtz::new(family, nodes),
            mean_square: 1.0,
            right: vec![0.0; nodes],
            solution: vec![0.0; nodes],
        }
    }

    /// Takes the component along κ out of `values`.
    pub(super) fn project(&self, kappa: &[f64], values: &mut [f64]) {
        let factor = mean_of_product(kappa, values) / self.mean_square;
        for (value, kappa) in values.iter_mut().zip(kappa) {
            *value -= factor * kappa;
        }
    }
}

impl NormalMobility for Incompressible {
    fn name(&self) -> &'static str {
        "incompressible"
    }

    fn set(&mut self, at: &CurveFields) -> Result<(), MobilityError> {
        let kappa = at.at_nodes(0);
        self.mean_square = mean_of_product(kappa, kappa);
        Ok(self.helmholtz.set(kappa, at.length())?)
    }

    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        let kappa = at.at_nodes(0);
        velocity.copy_from_slice(force);
        self.project(kappa, velocity);
        for ((right, kappa), f) in self.right.iter_mut().zip(kappa).zip(&*velocity) {
            *right = kappa * f;
        }
        self.helmholtz.solve(&self.right, &mut self.solution);
        for ((v, kappa), u) in velocity.iter_mut().zip(kappa).zip(&self.solution) {
            *v -= kappa * u;
        }
        self.project(kappa, velocity);
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
