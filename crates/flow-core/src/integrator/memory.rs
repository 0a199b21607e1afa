//! What a multistep method must know to go on as if it had never stopped.

use serde::{Deserialize, Serialize};

use super::history::MOST_POINTS;
use super::integrals::Integrals;
use super::newton::Factorisation;

/// Past states, integrals, step size and order; the rest is computed anew in every step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Times and states, newest first.
    pub points: Vec<(f64, Vec<f64>)>,
    /// The integrals carried along.
    pub integrals: Integrals,
    /// Age of the factorisation.
    pub factorisation: Factorisation,
    pub(super) order: usize,
    pub(super) last_order: usize,
    pub(super) step: f64,
    pub(super) steps_at_order: usize,
    pub(super) accepted: u64,
    pub(super) failures: u32,
}

impl Memory {
    /// Whether a method can go on from it with states of `size` entries.
    #[must_use]
    pub fn fits(&self, size: usize) -> bool {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let falling = self.points.windows(2).all(|pair| pair[0].0 > pair[1].0);
        let orders = 1..MOST_POINTS - 1;
        falling
            && self.integrals.is_sound()
            && (2..=MOST_POINTS).contains(&self.points.len())
            && self
                .points
                .iter()
                .all(|(time, state)| time.is_finite() && state.len() == size && finite(state))
            && orders.contains(&self.order)
            && orders.contains(&self.last_order)
            && self.points.len() > self.order.max(self.last_order)
            && self.step > 0.0
            && self.step.is_finite()
    }
}
