//! Whether new nodes are all that changes the energy. See `THEORY.md`, eq. (I7).

use serde::{Deserialize, Serialize};

use crate::integrator::{ENERGY_ROUNDING, StepReport};

/// Changes by remaps in a doubling of time that tell what remaps do from what the flow does.
const REMAPS: u32 = 8;

/// Watches what the energy does, remaps included, while the time doubles.
///
/// On nodes that follow the curve a state at rest goes down by the error of space from one remap to the next, and each remap takes it
/// up again. The steps alone lose energy for ever; over many remaps nothing is lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standstill {
    since: f64,
    energy_then: f64,
    last_energy: f64,
    remaps: u32,
    largest: f64,
}

impl Standstill {
    /// A watch from the time 0, at which the energy is `energy`.
    #[must_use]
    pub fn new(energy: f64) -> Self {
        Self::from(0.0, energy)
    }

    fn from(since: f64, energy: f64) -> Self {
        Self { since, energy_then: energy, last_energy: energy, remaps: 0, largest: 0.0 }
    }

    /// Takes an accepted step; true if the time has doubled, many remaps have changed the energy, and all in all it has fallen by no
    /// more than one of them did, and by `bound` at most.
    pub fn reached(&mut self, step: &StepReport, bound: f64) -> bool {
        let &StepReport { time, energy, lost, .. } = step;
        let change = (energy + lost - self.last_energy).abs();
        self.last_energy = energy;
        if change > ENERGY_ROUNDING * energy.abs() {
            self.remaps += 1;
            self.largest = self.largest.max(change);
        }
        if time < 2.0 * self.since {
            return false;
        }
        let stands = self.remaps >= REMAPS && self.energy_then - energy <= self.largest.min(bound);
        *self = Self::from(time, energy);
        stands
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of steps that lose `lost` each, every fifth of them after a remap that gives `back`: whether the flow stands still by t = 2000.
    fn stands(lost: f64, back: f64) -> bool {
        let mut watch = Standstill::new(1.0);
        let mut energy = 1.0;
        (1..2000).any(|step| {
            energy += if step % 5 == 0 { back } else { 0.0 };
            energy -= lost;
            watch.reached(&StepReport::taken(f64::from(step), 1.0, [energy, lost], lost), 1e-3)
        })
    }

    #[test]
    fn what_remaps_give_back_is_not_lost() {
        assert!(stands(1e-6, 5e-6));
        assert!(stands(1e-6, 4.99e-6));
    }

    #[test]
    fn a_flow_that_loses_more_does_not_stand_still() {
        assert!(!stands(1e-6, 4e-6));
        assert!(!stands(1e-6, -5e-6));
        assert!(!stands(1e-6, 0.0));
    }

    #[test]
    fn noise_above_the_bound_hides_nothing() {
        assert!(!stands(1e-3, 3e-3));
    }
}
