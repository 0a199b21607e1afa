//! Order and size of the next step.

use super::{Bdf, Clock, HIGHEST_ORDER};
use crate::integrator::clock;
use crate::integrator::pace::{LEAST_RATE, Next, growth_for};

/// Local errors may be this multiple of a tolerance of 1e-5: a dissipative flow forgets them. A tighter tolerance takes
/// more steps, as its root of the order of the error, whose errors add up: the multiple shrinks with them. It shrinks with looser ones
/// too, by this power: large errors excite stiff modes, whose cure costs more than shorter steps. The measured
/// errors of the shipped scenes are in `benches/README.md`.
const LOCAL_SHARE: f64 = 3.0;
const LOOSE_POWER: f64 = 0.25;

/// Local error for which the global error is about the tolerance.
pub(super) fn local_tolerance(tolerance: f64) -> f64 {
    let relative = tolerance / 1e-5;
    let power = if relative < 1.0 { 1.0 / (HIGHEST_ORDER + 1) as f64 } else { -LOOSE_POWER };
    LOCAL_SHARE * tolerance * relative.powf(power)
}

/// Steps times a frequency up to which the formulas of order 3, 4 and 5 multiply an undamped wave by at most 1.01 a step; those of lower
/// order damp it. (At order 5 it would be 1.37, a rounding grown to the size of the state in a hundred steps.)
const STABLE: [f64; HIGHEST_ORDER - 2] = [0.5, 0.55, 0.75];
/// The highest order without such a bound.
const ALWAYS_STABLE: usize = 2;

/// Safety factors on the error of order k − 1, k, k + 1: a change of order must pay.
const BIAS: [f64; 3] = [4.0, 4.0, 6.0];
/// … and on that of a step which is tried again: less, since its error is known.
pub(super) const BIAS_OF_FAILED: f64 = 2.0;
/// Part of the tolerance's root by which the first step moves the state.
const FIRST_PART: f64 = 0.1;

/// A stage that takes more than one solve, and more Krylov iterations than this in them, is one of a step that is too long to pay: …
const DEAR: usize = 10;
/// … the next one is at most this part of what its error would allow, …
const SHORTENED: f64 = 0.5;
/// … and the part grows by this factor with each step that is not.
const RECOVERY: f64 = 1.1;

/// A first step that moves the state by a small part of the tolerance's root: order 1 has error O(h²).
pub(super) fn first_step(tolerance: f64, rate: f64) -> f64 {
    FIRST_PART * tolerance.sqrt() / rate.max(LEAST_RATE)
}

impl Bdf {
    /// Factor between ‖y − ỹ‖ and the local error of the fixed-leading-coefficient formula.
    pub(super) fn error_factor(&self) -> f64 {
        let (end, times) = self.stretched(self.clock());
        let alpha = |back: usize| end / (end - times[back]);
        let last = alpha(self.pace.order);
        let alpha_0: f64 = -(0..self.pace.order).map(alpha).sum::<f64>();
        let alpha_s = -self.leading_coefficient();
        last.max((last + alpha_s - alpha_0).abs())
    }

    /// How far the polynomial of degree `order` in the time of `clock` misses the candidate.
    fn missed(&mut self, order: usize, clock: Clock) -> f64 {
        let weights = self.predictor(order, clock);
        self.history.combine(&weights.value, order + 1, &mut self.difference);
        for (difference, y) in self.difference.iter_mut().zip(&self.candidate) {
            *difference = y - *difference;
        }
        self.norm.norm(&self.difference)
    }

    /// Estimate of the local error of order `order` at constant step of `clock`, ‖h^{k+1} y^{(k+1)}‖/(k + 1), from what the polynomial
    /// of that degree has `missed`.
    fn error_of_order(&self, order: usize, clock: Clock, missed: f64) -> f64 {
        let mut factor = 1.0 / (order + 1) as f64;
        let (end, times) = self.stretched(clock);
        for back in 0..=order {
            factor *= end / (end - times[back]) * (back + 1) as f64;
        }
        factor * missed
    }

    /// Ratio of the next step size that keeps an error at the tolerance.
    pub(super) fn growth(&self, error: f64, order: usize, bias: f64) -> f64 {
        growth_for(bias * error / self.tolerance, (order + 1) as f64)
    }

    /// Growth of the step up to which order `order` multiplies no undamped wave.
    fn stable_growth(&self, order: usize) -> f64 {
        if order <= ALWAYS_STABLE || self.undamped == 0.0 {
            return f64::INFINITY;
        }
        STABLE[order - ALWAYS_STABLE - 1] / (self.pace.step * self.undamped)
    }

    /// The rate of the clock that would have served this step best, with how much its polynomial misses.
    fn best_stretch(&mut self) -> (f64, f64) {
        let (order, present, start) = (self.pace.order, self.pace.stretch, self.history.times()[0]);
        let others = clock::others(present, self.pace.reach(self.history.times()));
        let missed = self.missed(order, self.clock());
        let others = others.map(|other| (other, self.missed(order, Clock::new(start, other))));
        clock::best((present, missed), others)
    }

    /// Part of what its error would allow that the next step takes. A solve that must be corrected again costs more than two steps of half
    /// the size, whose errors are smaller besides.
    fn share(&self) -> f64 {
        let effort = self.newton.effort();
        if effort.solves > 1 && effort.iterations > DEAR {
            SHORTENED
        } else {
            (RECOVERY * self.pace.share).min(1.0)
        }
    }

    /// Order and step size after an accepted candidate (which is not yet in the history).
    pub(super) fn plan(&mut self, most_growth: f64) {
        let (order, (stretch, missed)) = (self.pace.order, self.best_stretch());
        let clock = Clock::new(self.history.times()[0], stretch);
        let next = |bdf: &Self, order, missed, bias| {
            let error = bdf.error_of_order(order, clock, missed);
            let growth = bdf.growth(error, order, bias).min(bdf.stable_growth(order));
            Next { order, growth, stretch }
        };
        let mut best = next(self, order, missed, BIAS[1]);
        if self.pace.steps_at_order > order {
            if order > 1 {
                let missed = self.missed(order - 1, clock);
                best = best.or(next(self, order - 1, missed, BIAS[0]));
            }
            if order > ALWAYS_STABLE + 1 && self.undamped > 0.0 {
                let missed = self.missed(ALWAYS_STABLE, clock);
                best = best.or(next(self, ALWAYS_STABLE, missed, BIAS[0]));
            }
            if order < HIGHEST_ORDER && self.history.len() > order + 1 {
                let missed = self.missed(order + 1, clock);
                best = best.or(next(self, order + 1, missed, BIAS[2]));
            }
        }
        self.pace.share = self.share();
        best.growth *= self.pace.share;
        self.pace.go_on(best, most_growth, self.history.times(), |factor| factor);
    }
}
