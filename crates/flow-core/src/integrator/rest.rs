//! When the energy has stopped falling, to rounding. See `THEORY.md`, eq. (I9).

use serde::{Deserialize, Serialize};

/// Steps that the energy must have stayed the same.
const STEPS: u32 = 8;

/// Watches the energy of the accepted states.
///
/// The flow is at rest to rounding once the energy has not changed by more than its rounding while the time doubled, in
/// many steps. It may go on all the same, and does so as long as the steps find a way down; but a step that fails
/// there fails on rounding, and the state may stay where it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    energy: f64,
    since: f64,
    steps: u32,
}

impl Rest {
    /// A watch from a state of energy `energy` at `time`.
    #[must_use]
    pub fn new(time: f64, energy: f64) -> Self {
        Self { energy, since: time, steps: 0 }
    }

    /// Takes an accepted step; `rounding` is that of the energy.
    pub fn watch(&mut self, time: f64, energy: f64, rounding: f64) {
        if (energy - self.energy).abs() > rounding {
            *self = Self::new(time, energy);
        } else {
            self.steps = self.steps.saturating_add(1);
        }
    }

    /// Takes the flow for at rest with this `energy` from now on.
    pub fn reach(&mut self, energy: f64) {
        *self = Self { energy, since: 0.0, steps: STEPS };
    }

    /// Whether the flow is at rest at `time`.
    #[must_use]
    pub fn reached(&self, time: f64) -> bool {
        self.steps >= STEPS && time >= 2.0 * self.since
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn watched(energy: impl Fn(f64) -> f64) -> bool {
        let mut rest = Rest::new(0.0, energy(0.0));
        let mut time = 1e-9;
        while time < 100.0 {
            rest.watch(time, energy(time), 1e-13);
            time *= 1.02;
        }
        rest.reached(time)
    }

    #[test]
    fn a_decayed_flow_is_at_rest() {
        assert!(watched(|time| 1.0 + (-time).exp()));
        assert!(watched(|_| 1.0));
    }

    #[test]
    fn a_flow_that_creeps_visibly_is_not() {
        assert!(!watched(|time| 1.0 - 1e-14 * time));
    }

    #[test]
    fn what_is_taken_for_at_rest_is_until_its_energy_changes() {
        let mut rest = Rest::new(0.0, 2.0);
        rest.watch(1.0, 1.0, 1e-13);
        rest.reach(1.0);
        assert!(rest.reached(1.0));
        rest.watch(1.1, 1.0 - 5e-14, 1e-13);
        assert!(rest.reached(1.1));
        rest.watch(1.2, 0.999, 1e-13);
        assert!(!rest.reached(1.2));
    }

    #[test]
    fn many_steps_within_a_short_time_are_no_rest() {
        let mut rest = Rest::new(0.0, 2.0);
        rest.watch(1.0, 1.0, 1e-13);
        for step in 1..100 {
            rest.watch(1.0 + 1e-3 * f64::from(step), 1.0, 1e-13);
        }
        assert!(!rest.reached(1.1) && rest.reached(2.0));
    }
}
