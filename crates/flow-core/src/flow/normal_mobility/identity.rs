//! L² flow: 𝓑 = Id. See `THEORY.md`, eq. (F4).

use super::NormalMobility;
use crate::flow::CurveFields;

/// The L² flow, 𝓑 = Id: V = f. See `THEORY.md`, eq. (F4).
#[derive(Clone, Copy, Debug, Default)]
pub struct Identity;

impl NormalMobility for Identity {
    fn is_identity(&self) -> bool {
        true
    }

    fn apply(&mut self, _: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        velocity.copy_from_slice(force);
    }

    fn symbol(&self, _: f64) -> f64 {
        1.0
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(*self)
    }
}
