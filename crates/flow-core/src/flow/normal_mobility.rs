//! Normal mobilities 𝓑: self-adjoint, ≥ 0. See `THEORY.md`, eq. (F4).

use std::fmt::Debug;

use super::curve_fields::CurveFields;

/// Turns the force on the normal motion into the normal velocity.
pub trait NormalMobility: Debug + Send + Sync {
    /// Name in scenes.
    fn name(&self) -> &'static str;

    /// V = 𝓑f at the state `at`. Shapes: one value per node.
    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]);
}

/// L² flow: V = f.
#[derive(Clone, Copy, Debug, Default)]
pub struct Identity;

impl NormalMobility for Identity {
    fn name(&self) -> &'static str {
        "identity"
    }

    fn apply(&mut self, _: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        velocity.copy_from_slice(force);
    }
}
