//! When a flow is at rest, judged by its dissipation. See `THEORY.md`, eq. (I7).

use serde::{Deserialize, Serialize};

use super::departure::Departure;
use super::standstill::Standstill;
use crate::integrator::{ENERGY_ROUNDING, StepReport};

/// Part of the energy lost so far that counts as energy scale, where the energy itself is near zero: a stiff penalty that the initial data break may be a million times the energy of the curve.
const PART_OF_LOSS_AT_REST: f64 = 1e-6;
/// Energy below this part of the scale is rounding.
const ROUNDING: f64 = 1e-15;
/// Steps that must agree.
const STEPS: u32 = 5;
/// … and that are as good as a doubling of time: rounding keeps steps short that nothing else would.
const MANY_STEPS: u32 = 100;
/// What a flow at rest may lose by creeping on to the end as it does, in units of what it may still lose.
const CREEP: f64 = 100.0;

/// Watches the dissipation.
///
/// The energy still to be lost is about D·t, or ∫D dt to the end if D goes on as it does, by a power of the time, and that is more:
/// from rough data a flow settles by powers above −1, and a stiff penalty dies long before the curve has moved, so that early on D·t is
/// small, and yet nearly all is to come. The flow is at rest once that has stayed below a part of the energy while the time doubled, and
/// D itself, if it stayed as it is to the end, would not lose a hundred times as much, which is the tolerance unless the scene says
/// otherwise: a fast layer hides what comes after it. A flow that creeps (a metastable state) is at rest by this measure.
///
/// D counts as far as the energy falls by it: what solves leave in stiff modes dissipates, and moves nothing. Low down rounding makes the
/// power a matter of chance, and some flows creep on: they stay at rest as long as the mean rate since then would not lose more either,
/// which, over many steps, is as good as a doubling of time; but not if what they lose has grown all the while, as near a saddle, and by
/// going on so would come to more: see `Departure`. What steps lose on nodes that follow the curve remaps may give back: see
/// `Standstill`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equilibrium {
    tolerance: f64,
    initial_energy: f64,
    end: f64,
    last: (f64, f64),
    /// Since when little is to come, and the energy lost since then.
    quiet: Option<(f64, f64)>,
    quiet_steps: u32,
    departure: Departure,
    remapped: Standstill,
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
            quiet: None,
            quiet_steps: 0,
            departure: Departure::new(),
            remapped: Standstill::new(energy),
        }
    }

    /// Takes an accepted step, after which the flow can change `energy_scale` of its energy; true if it is at rest.
    pub fn reached(&mut self, step: &StepReport, energy_scale: f64) -> bool {
        let &StepReport { time, size, energy, lost, settled_dissipation: dissipation, .. } = step;
        let scale = energy_scale.max(PART_OF_LOSS_AT_REST * (self.initial_energy - energy));
        // Nothing that double precision can see will happen before the end.
        if dissipation * self.end <= ROUNDING * scale {
            return true;
        }
        let (last_time, last_dissipation) = self.last;
        let rounding = ENERGY_ROUNDING * energy.abs();
        let dissipation = dissipation.min((lost.max(0.0) + rounding) / size);
        self.last = (time, dissipation);
        let power = (last_dissipation / dissipation).ln() / (time / last_time).ln();
        let remaining = dissipation * time * to_come(power, self.end / time).max(1.0);
        let bound = self.tolerance * scale;
        if self.remapped.reached(step, bound) {
            return true;
        }
        let left = self.end - time;
        let creeps = |rate: f64| rate * left <= CREEP * bound;
        let stands_still = self.quiet.as_mut().is_some_and(|(since, sum)| {
            *sum += lost;
            creeps((sum.max(0.0) + rounding) / (time - *since))
        });
        if remaining > bound && !stands_still {
            (self.quiet, self.quiet_steps) = (None, 0);
            return false;
        }
        self.quiet_steps = self.quiet_steps.saturating_add(1);
        let Some((since, sum)) = self.quiet else {
            self.quiet = Some((time, 0.0));
            self.departure.begin(time);
            return false;
        };
        self.departure.take(time, sum);
        let rests = self.quiet_steps >= STEPS && time >= 2.0 * since && creeps(dissipation)
            || self.quiet_steps >= MANY_STEPS && stands_still;
        if rests && self.departure.to_come(left) > CREEP * bound {
            (self.quiet, self.quiet_steps) = (None, 0);
            return false;
        }
        rests
    }
}

/// ∫₁^`end` x^−`power` dx.
fn to_come(power: f64, end: f64) -> f64 {
    let exponent = (1.0 - power) * end.ln();
    if exponent == 0.0 { end.ln() } else { end.ln() * exponent.exp_m1() / exponent }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a flow with these energies and dissipations, from rest at `start`, at times that grow by `ratio`: when it is at rest.
    fn rest(
        watch: &mut Equilibrium,
        (start, end, ratio): (f64, f64, f64),
        energy: impl Fn(f64) -> f64,
        dissipation: impl Fn(f64) -> f64,
    ) -> Option<f64> {
        let mut last = 0.0;
        let times =
            std::iter::successors(Some(start), |time| Some(ratio * time)).take_while(|time| *time < end);
        let mut rest = times.filter(|&time| {
            let (size, lost) = (time - last, energy(last) - energy(time));
            last = time;
            watch.reached(
                &StepReport::taken(time, size, [energy(time), lost], dissipation(time)),
                energy(time).abs(),
            )
        });
        rest.next()
    }

    /// D = 2λE e^{−2λt}, E∞ = 1.
    fn stops_at(rate: f64, end: f64) -> Option<f64> {
        let energy = |t: f64| 1.0 + (-2.0 * rate * t).exp();
        let dissipation = |t: f64| 2.0 * rate * (-2.0 * rate * t).exp();
        let mut watch = Equilibrium::new(1e-7, energy(0.0), dissipation(0.0), end);
        rest(&mut watch, (1e-9, end, 1.05), energy, dissipation)
    }

    #[test]
    fn an_exponential_decay_is_at_rest_after_it_has_decayed() {
        for rate in [0.1, 1.0, 30.0] {
            let time = stops_at(rate, 1e4).unwrap();
            assert!((-2.0 * rate * time).exp() < 1e-7 && time < 40.0 / rate, "rate {rate}: stops at {time}");
        }
    }

    /// A stiff penalty dies, then the curve moves: D falls by decades and stays, D·t small, until t = 1.
    #[test]
    fn a_fast_layer_is_not_the_rest_of_a_slow_flow() {
        for (fast, slow) in [(1e8, 1.0), (1e4, 1.0), (1e8, 1e-3), (1e12, 1e-2)] {
            for layer in [1e-2, 1.0, 1e4, 1e8] {
                let energy = |t: f64| 1.0 + layer * (-fast * t).exp() + (-slow * t).exp();
                let dissipation = |t: f64| layer * fast * (-fast * t).exp() + slow * (-slow * t).exp();
                for ratio in [1.05, 1.5] {
                    let mut watch = Equilibrium::new(1e-7, energy(0.0), dissipation(0.0), 1e2 / slow);
                    let time = rest(&mut watch, (1e-4 / fast, 1e2 / slow, ratio), energy, dissipation);
                    let left = time.map(|time| (-slow * time).exp());
                    assert!(left.is_some_and(|left| left < 1e-5), "{fast}, {slow}, {layer}: at {time:?}");
                }
            }
        }
    }

    /// What solves leave in stiff modes shows in the dissipation, not in the energy.
    #[test]
    fn a_dissipation_that_flickers_does_not_put_off_the_rest() {
        let energy = |t: f64| 1.0 + (-2.0 * t).exp();
        let stops_at = |flicker: f64| {
            let mut watch = Equilibrium::new(1e-7, 2.0, 2.0, 1e4);
            let count = std::cell::Cell::new(0);
            rest(&mut watch, (1e-9, 1e4, 1.05), energy, |time| {
                count.set(count.get() + 1);
                let noise = if count.get() % 3 == 0 { flicker } else { 0.0 };
                2.0 * (-2.0 * time).exp() + noise
            })
        };
        let (plain, flickering) = (stops_at(0.0).unwrap(), stops_at(1e-3).unwrap());
        assert!(flickering < 1.2 * plain, "{flickering} and {plain}");
    }

    /// Where the energy goes down with it, the dissipation is none of a solve.
    #[test]
    fn a_flow_that_gets_going_again_is_not_at_rest() {
        let mut watch = Equilibrium::new(1e-4, 1.0, 1.0, 1e4);
        let steps =
            [(20.0, 20.0, [0.5, 0.5], 1e-9), (21.0, 1.0, [0.5, 0.0], 1e-9), (25.0, 4.0, [0.49, 0.01], 1e-3)];
        for (time, size, energies, dissipation) in steps {
            assert!(!watch.reached(&StepReport::taken(time, size, energies, dissipation), energies[0]));
        }
        let quiet = |time: &f64| watch.reached(&StepReport::taken(*time, 1.0, [0.49, 0.0], 1e-9), 0.49);
        let rest = (0..100).map(|step| 26.0 + f64::from(step)).find(quiet);
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
        let (energy, dissipation) = (|t: f64| 10.0 - 3.0 * t.powf(0.25), |t: f64| 0.75 * t.powf(-0.75));
        assert_eq!(rest(&mut watch, (1e-12, 1.0, 2.5), energy, dissipation), None);
    }

    /// Near a saddle: what came with the data decays, then what the saddle does not hold grows.
    #[test]
    fn a_flow_that_leaves_a_saddle_is_not_at_rest() {
        let rests = |amplitude: f64| {
            let energy = |t: f64| 2.0 + (-2.0 * t).exp() - amplitude * (t / 14.0).exp();
            let dissipation = |t: f64| 2.0 * (-2.0 * t).exp() + amplitude / 14.0 * (t / 14.0).exp();
            let mut watch = Equilibrium::new(1e-7, energy(0.0), dissipation(0.0), 100.0);
            (1..600).any(|step| {
                let [last, time] = [step - 1, step].map(|step| f64::from(step) / 6.0);
                let lost = energy(last) - energy(time);
                watch.reached(
                    &StepReport::taken(time, time - last, [energy(time), lost], dissipation(time)),
                    2.0,
                )
            })
        };
        assert!(!rests(1e-6), "8e-4 of 2 are lost until the end");
        assert!(rests(1e-9), "8e-7 of 2 are");
    }

    /// Steps that rounding keeps at a hundredth of the time in which anything happens would take as many as that to double it.
    #[test]
    fn steps_that_rounding_keeps_short_do_not_put_off_the_rest() {
        let mut watch = Equilibrium::new(1e-5, 2.0, 2.0, 1e8);
        let energy = |step: u32| 1.0 + 1e-13 * f64::from(step % 3);
        let taken = (1..100_000).find(|&count| {
            let lost = energy(count - 1) - energy(count);
            let time = 1e3 + 0.05 * f64::from(count);
            watch.reached(&StepReport::taken(time, 0.05, [energy(count), lost], 1e-4), energy(count))
        });
        assert!(taken.is_some_and(|taken| taken < 200), "{taken:?}");
    }

    #[test]
    fn a_state_without_forces_is_at_rest_at_once() {
        let mut watch = Equilibrium::new(1e-7, 1.0, 0.0, 10.0);
        assert!(watch.reached(&StepReport::taken(1e-6, 1e-6, [1.0, 0.0], 1e-30), 1.0));
    }

    /// E = e^{−2t}: what is small beside the energy at the time is never all of it, what is small beside the energy lost is.
    #[test]
    fn a_flow_that_loses_all_its_energy_comes_to_rest() {
        let energy = |t: f64| (-2.0 * t).exp();
        let mut watch = Equilibrium::new(1e-5, 1.0, 2.0, 300.0);
        let at_rest = rest(&mut watch, (1e-3, 130.0, 1.03), energy, |t| 2.0 * energy(t));
        assert!(at_rest.is_some_and(|time| energy(time) < 1e-8), "{at_rest:?}");
    }
}
