//! Order and size of the next step, and the watch over what limits it.

use serde::{Deserialize, Serialize};

use super::formula::weights_at_end;
use super::memory::ENOUGH;
use super::orders::HIGHEST_ORDER;
use super::substitution::StepClock;
use super::sums::Correction;
use super::{Exponential, MOST_CHANGES, OLDEST_PART};
use crate::integrator::Rejection;
use crate::integrator::clock;
use crate::integrator::pace::{Next, growth_for, on_scale, shrinking};

/// Safety factors on the error of order k − 1, k, k + 1: a change of order must pay.
const BIAS: [f64; 3] = [3.0, 2.0, 3.0];
/// What the power of the step size in the error is above the order: between that where Λ is stiff, 1, and that where it is not, 2.
const BETWEEN_ORDERS: f64 = 1.5;
/// Contraction of the corrector above which what it leaves out, the stiffness of N, limits the steps.
const STIFF: f64 = 0.4;
/// … or its multiple of that from which on errors grow from step to step, where that is less.
const UNSTABLE: f64 = 2.0;
/// What a step counts at most whose error would have let it grow farther than the stiffness.
const MOST_LIMITED: u32 = 8;
/// Contraction above which steps that the balance keeps from growing are limited by the stiffness of N, if the error would let them grow by …
const UNBALANCED: f64 = 0.1;
/// … this factor.
const MUCH_LONGER: f64 = 4.0;
/// What an attempt that is thrown away counts; a step that is not limited takes one away again.
pub(super) const LIMITED: u32 = 2;
/// Steps in which the clock is looked for; after them it is compared with others in every second one.
const SEARCH: u64 = 16;
/// Steps do not grow beyond this contraction: at one, rounding would.
const MOST_CONTRACTION: f64 = 0.7;

/// What the corrector may leave of the way to its fixed point, in units of the tolerance: the differences of its polynomials do not see it.
const LEFT: f64 = 5.0;
/// Growth of the contraction, above [`STIFF`] and in a step that is not longer, that tells of errors that grow by themselves …
const ERUPTION: f64 = 1.5;
/// … where a second correction changes as much, in units of the tolerance: less may be rounding.
const SEEN: f64 = 1.0;
/// Contraction above which Λ is taken anew before its time, if it was less than half of this with Λ as it was.
const OUTDATED: f64 = 0.2;

/// What the stiffness of N does to the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Stiffness {
    /// Count of the steps that it has limited.
    pub limited: u32,
    /// Contraction of the corrector in the last step, and the size of that.
    pub last: (f64, f64),
    /// Contraction of the first step with the present Λ.
    pub fresh: f64,
}

impl Stiffness {
    /// Whether the coefficients of the flow have changed so much since Λ was taken that N has become stiff.
    pub fn is_part_outdated(&self) -> bool {
        self.last.0 > OUTDATED.max(2.0 * self.fresh)
    }

    /// Whether the shortest waves, in which N is stiffer than what the norm sees of it, have grown until it sees them.
    fn erupts(&self, contraction: f64, step: f64) -> bool {
        let (last, size) = self.last;
        contraction > STIFF && step <= size && contraction > ERUPTION * last
    }

    pub fn is_sound(&self) -> bool {
        let (contraction, size) = self.last;
        [contraction, size, self.fresh].iter().all(|value| value.is_finite() && *value >= 0.0)
    }
}

/// Contraction above which steps of order `order` are limited by the stiffness of N: a prediction through k values multiplies errors
/// of N that alternate from step to step by 2ᵏ − 1, and two corrections shrink them by the square of the contraction.
fn stiff(order: usize) -> f64 {
    STIFF.min(UNSTABLE / (2.0_f64.powi(order as i32) - 1.0).sqrt())
}

impl Exponential {
    /// Ratio of the next step size that keeps an error of order `order` at the tolerance.
    fn growth(&self, error: f64, order: usize, bias: f64) -> f64 {
        growth_for(bias * error / self.tolerance, order as f64 + BETWEEN_ORDERS)
    }

    /// After an attempt that was thrown away.
    pub(super) fn fail(&mut self, factor: f64) {
        self.stiffness.limited += LIMITED;
        self.pace.fail(on_scale(factor));
    }

    /// Looks at what a second correction would change of the candidate: over what the first one did, it is the contraction; too much of it
    /// is an error of the step.
    pub(super) fn watch_contraction(&mut self) -> Result<(), Rejection> {
        self.correct_again();
        let again = self.norm.norm(&self.changes[0]);
        self.scratch.iter_mut().zip(&self.candidate).zip(&*self.predicted).for_each(|((d, y), p)| *d = y - p);
        let contraction = again / self.norm.norm(&self.scratch).max(f64::MIN_POSITIVE);
        if again > SEEN * self.tolerance && self.stiffness.erupts(contraction, self.pace.step) {
            // With another Λ it may be over; else it is the end of the method.
            if self.part_age == 0 {
                self.stiffness.limited += ENOUGH;
            }
            self.part_age = OLDEST_PART;
            self.fail(1.0);
            return Err(Rejection::Error);
        }
        self.stiffness.last = (contraction, self.pace.step);
        if self.part_age == 0 {
            self.stiffness.fresh = contraction;
        }
        self.hold_to_tolerance(again / LEFT)
    }

    /// Finds the clock by which a prediction, through two values of N at least, would have missed least; `correction` is of the kind
    /// that makes it good.
    pub(super) fn compare_clocks(&mut self, correction: Correction) {
        let points = correction.points.max(2);
        self.best_stretch = self.pace.stretch;
        let due = self.pace.accepted < SEARCH || self.pace.accepted.is_multiple_of(2);
        if due && points <= self.states.len() {
            let present = self.pace.stretch;
            let [first, second] = clock::others(present, self.pace.reach(self.states.times()));
            let mut corrections = [Correction { points, ..correction }; 3];
            for (correction, stretch) in corrections.iter_mut().zip([first, second, present]) {
                let nodes = self.nodes_by(points, StepClock::new(stretch * self.pace.step));
                correction.weights = weights_at_end(&nodes[..points]);
            }
            // The corrector's own change is the last of the three, if it has as many points.
            let own = (points == correction.points).then(|| self.norm.norm(&self.changes[0]));
            self.change(&corrections[..if own.is_some() { 2 } else { 3 }]);
            let missed = |change: usize| self.norm.norm(&self.changes[change]);
            let own = own.unwrap_or_else(|| missed(2));
            let others = [(first, missed(0)), (second, missed(1))];
            self.best_stretch = clock::best((present, own), others).0;
        }
    }

    /// Numbers of values of N whose differences tell the error at this order, and at its neighbours where the order may change
    /// after this step.
    pub(super) fn watched(&self) -> [usize; MOST_CHANGES - 1] {
        let order = self.pace.order;
        let neighbours = if self.pace.steps_at_order >= order { [order - 1, order + 2] } else { [0, 0] };
        [order, order + 1, neighbours[0], neighbours[1]]
    }

    /// Whether the error of the candidate is below the tolerance.
    pub(super) fn judge(&mut self) -> Result<(), Rejection> {
        self.hold_to_tolerance(self.error(self.pace.order).unwrap_or(f64::NAN))
    }

    /// Throws the attempt away if `error` is above the tolerance.
    fn hold_to_tolerance(&mut self, error: f64) -> Result<(), Rejection> {
        if error <= self.tolerance {
            return Ok(());
        }
        let growth = if error.is_finite() { self.growth(error, self.pace.order, BIAS[1]) } else { 0.0 };
        self.fail(shrinking(growth));
        Err(if error.is_finite() { Rejection::Error } else { Rejection::NotFinite })
    }

    /// Estimate of the error at order `order`, for a power of the step size; none if too few values of N are known.
    ///
    /// What one value less changes is the error where Λ is stiff; where it is not, the corrector's own order is higher by one, and
    /// what one value more changes is it. Between the two lies their geometric mean.
    fn error(&self, order: usize) -> Option<f64> {
        let stiff = self.differences[order].filter(|_| order <= HIGHEST_ORDER)?;
        Some(self.differences[order + 1].map_or(stiff, |other| (stiff * other).sqrt()))
    }

    /// Order and size of the step after an accepted candidate.
    pub(super) fn plan(&mut self, most_growth: f64) {
        let order = self.pace.order;
        let (stretch, contraction) = (self.best_stretch, self.stiffness.last.0);
        let next = |order, error: Option<f64>, bias| {
            let growth = error.map_or(0.0, |error| self.growth(error, order, bias));
            Next { order, growth, stretch }
        };
        let mut best = next(order, self.error(order), BIAS[1]);
        if self.pace.steps_at_order > order {
            best = best.or(next(order - 1, self.error(order - 1), BIAS[0]));
            best = best.or(next(order + 1, self.error(order + 1), BIAS[2]));
        }
        let free = best.growth;
        best.growth = free.min(MOST_CONTRACTION / contraction);
        self.stiffness.limited = if contraction > stiff(order) {
            // What the stiffness leaves in the stiffest modes takes the step out of balance before it shows in its error.
            let lost = free / best.growth.min(most_growth);
            self.stiffness.limited + (lost.powi(2) as u32).clamp(1, MOST_LIMITED)
        } else if contraction > UNBALANCED && most_growth <= 1.0 && free > MUCH_LONGER {
            // One stiff direction, as that of an area under a penalty, is out of balance long before the norm sees it.
            self.stiffness.limited + LIMITED
        } else {
            self.stiffness.limited.saturating_sub(1)
        };
        self.pace.go_on(best, most_growth, self.states.times(), on_scale);
    }
}
