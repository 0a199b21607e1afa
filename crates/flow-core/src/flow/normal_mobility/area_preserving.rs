//! Area held: 𝓑 = Id − ⟨·⟩. See `THEORY.md`, eq. (F9).

use super::{Kept, NormalMobility};
use crate::flow::CurveFields;

/// The area is held: V = f − ⟨f⟩, the mean over the curve. See `THEORY.md`, eq. (F9).
#[derive(Clone, Copy, Debug, Default)]
pub struct AreaPreserving;

impl NormalMobility for AreaPreserving {
    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        let mean = at.mean(force);
        for (v, f) in velocity.iter_mut().zip(force) {
            *v = f - mean;
        }
    }

    fn symbol(&self, wave_square: f64) -> f64 {
        if wave_square == 0.0 { 0.0 } else { 1.0 }
    }

    fn keeps(&self) -> Kept {
        Kept { length: false, area: true }
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(*self)
    }
}
