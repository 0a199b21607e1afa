//! When a flow is at rest, judged by its dissipation. See `THEORY.md`, eq. (I7).

use serde::{Deserialize, Serialize};

/// Part of the energy lost so far that counts as energy scale, where the energy itself is near zero.
const PART_OF_LOSS: f64 = 1e-3;
/// Energy below this part of the scale is rounding.
const ROUNDING: f64 = 1e-15;
/// Steps that must agree.
const STEPS: u32 = 5;

/// Watches the dissipation.
///
/// The energy still to be lost is about D·t, or ∫D dt to the end if D goes on as it does, by a power of the time, and that is more:
/// from rough data a flow settles by powers above −1, so that early on D·t is small, and yet nearly all is to come. The flow is
/// at rest once D·t has stayed below a part of the energy while the time doubled. A flow that creeps (a metastable state) is at rest
/// by this measure, to the tolerance asked for. A step with more dissipation does not count if the energy lost since then is less
/// than that part: what solves leave in stiff modes dissipates, and moves nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equilibrium {
    tolerance: f64,
    initial_energy: f64,
    end: f64,
    last: (f64, f64),
    /// Since when, and from which energy.
    quiet_since: Option<(f64, f64)>,
    quiet_steps: u32,
}

impl Equilibrium {
    /// A watch from an initial energy and dissipation, for a run until `end`.
    #[must_use]
    pub fn new(tolerance: f64, energy: f64, dissipation: f64, end: f64) -> Self {
        Self {
            tolerance,
            initial_energy: energy,
            end,
            last: (0.0, dissipation),
            quiet_since: None,
            quiet_steps: 0,
        }
    }

    /// Takes an accepted step; true if the flow is at rest.
    pub fn reached(&mut self, time: f64, energy: f64, dissipation: f64) -> bool {
        let scale = energy_scale(self.initial_energy, energy);
        let (last_time, last_dissipation) = self.last;
        self.last = (time, dissipation);
        // Nothing that double precision can see will happen before the end.
        if dissipation * self.end <= ROUNDING * scale {
            return true;
        }
        let power = (last_dissipation / dissipation).ln() / (time / last_time).ln();
        let remaining = dissipation * time * to_come(power, self.end / time).max(1.0);
        let bound = self.tolerance * scale;
        // Rounding makes the dissipation flicker once it is low.
        if remaining > bound && (self.quiet_since.is_none() || dissipation * time > bound) {
            if self.quiet_since.is_some_and(|(_, before)| before - energy > bound) {
                self.quiet_since = None;
            }
            if self.quiet_since.is_none() {
                self.quiet_steps = 0;
            }
            return false;
        }
        self.quiet_steps = self.quiet_steps.saturating_add(1);
        let (since, _) = *self.quiet_since.get_or_insert((time, energy));
        self.quiet_steps >= STEPS && time >= 2.0 * since
    }
}

/// ∫₁^`end` x^−`power` dx.
fn to_come(power: f64, end: f64) -> f64 {
    let exponent = (1.0 - power) * end.ln();
    if exponent == 0.0 { end.ln() } else { end.ln() * exponent.exp_m1() / exponent }
}

/// What counts as small of an energy that fell from `initial`.
#[must_use]
pub fn energy_scale(initial: f64, energy: f64) -> f64 {
    energy.abs().max(PART_OF_LOSS * (initial - energy))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D = 2λE e^{−2λt}, E∞ = 1.
    fn stops_at(rate: f64, end: f64) -> Option<f64> {
        let energy = |t: f64| 1.0 + (-2.0 * rate * t).exp();
        let dissipation = |t: f64| 2.0 * rate * (-2.0 * rate * t).exp();
        let mut watch = Equilibrium::new(1e-7, energy(0.0), dissipation(0.0), end);
        let mut time = 1e-9;
        while time < end {
            time *= 1.05;
            if watch.reached(time, energy(time), dissipation(time)) {
                return Some(time);
            }
        }
        None
    }

    #[test]
    fn an_exponential_decay_is_at_rest_after_it_has_decayed() {
        for rate in [0.1, 1.0, 30.0] {
            let time = stops_at(rate, 1e4).unwrap();
            assert!((-2.0 * rate * time).exp() < 1e-7 && time < 40.0 / rate, "rate {rate}: stops at {time}");
        }
    }

    /// What solves leave in stiff modes shows in the dissipation, not in the energy.
    #[test]
    fn a_dissipation_that_flickers_does_not_put_off_the_rest() {
        let energy = |t: f64| 1.0 + (-2.0 * t).exp();
        let stops_at = |flicker: f64| {
            let mut watch = Equilibrium::new(1e-7, 2.0, 2.0, 1e4);
            let times =
                (0..).map(|step| (step, 1e-9 * 1.05_f64.powi(step))).take_while(|(_, time)| *time < 1e4);
            let mut rest = times.filter(|(step, time)| {
                let noise = if step % 3 == 0 { flicker } else { 0.0 };
                watch.reached(*time, energy(*time), 2.0 * (-2.0 * time).exp() + noise)
            });
            rest.next().map(|(_, time)| time)
        };
        let (plain, flickering) = (stops_at(0.0).unwrap(), stops_at(1e-3).unwrap());
        assert!(flickering < 1.2 * plain, "{flickering} and {plain}");
    }

    /// Where the energy goes down with it, the dissipation is none of a solve.
    #[test]
    fn a_flow_that_gets_going_again_is_not_at_rest() {
        let mut watch = Equilibrium::new(1e-4, 1.0, 1.0, 1e4);
        for (time, energy, dissipation) in [(20.0, 0.5, 1e-9), (21.0, 0.5, 1e-9), (25.0, 0.49, 1e-3)] {
            assert!(!watch.reached(time, energy, dissipation));
        }
        let rest = (0..100).map(|step| 26.0 + f64::from(step)).find(|time| watch.reached(*time, 0.49, 1e-9));
        assert!(rest.is_some_and(|time| time >= 52.0), "{rest:?}");
    }

    #[test]
    fn a_slow_flow_is_not_at_rest_at_the_start() {
        assert_eq!(stops_at(1e-3, 1e2), None);
    }

    /// D = ¾t^{−¾}, as of a curve with a kink.
    #[test]
    fn a_flow_that_settles_by_a_power_of_the_time_is_not_at_rest() {
        let mut watch = Equilibrium::new(1e-3, 10.0, f64::MAX, 1.0);
        let mut time = 1e-12;
        while time < 1.0 {
            assert!(!watch.reached(time, 10.0 - 3.0 * time.powf(0.25), 0.75 * time.powf(-0.75)), "at {time}");
            time *= 2.5;
        }
    }

    #[test]
    fn a_state_without_forces_is_at_rest_at_once() {
        let mut watch = Equilibrium::new(1e-7, 1.0, 0.0, 10.0);
        assert!(watch.reached(1e-6, 1.0, 1e-30));
    }

    /// E = e^{−2t}: what is small beside the energy at the time is never all of it, what is small beside the energy lost is.
    #[test]
    fn a_flow_that_loses_all_its_energy_comes_to_rest() {
        let energy = |t: f64| (-2.0 * t).exp();
        let mut watch = Equilibrium::new(1e-5, 1.0, 2.0, 300.0);
        let at_rest = (1..400)
            .map(|i| 1e-3 * 1.03_f64.powi(i))
            .find(|t| watch.reached(*t, energy(*t), 2.0 * energy(*t)));
        assert!(at_rest.is_some_and(|time| energy(time) < 1e-8), "{at_rest:?}");
    }
}
