//! Order and size of the next step, and the watch over what limits it.

use super::sums::Correction;
use super::{Exponential, HIGHEST_ORDER, MOST_CHANGES, MOST_MOMENTS};
use crate::integrator::Rejection;

/// Safety factors on the error of order k − 1, k, k + 1: a change of order must pay.
const BIAS: [f64; 3] = [3.0, 2.0, 3.0];
/// Contraction of the corrector above which what it leaves out, the stiffness of N, limits the steps.
pub(super) const STIFF: f64 = 0.4;
/// What a step that is limited so counts, over what one that is not takes away again: at rest, where both corrections are
/// rounding, they take turns.
pub(super) const LIMITED: u32 = 2;
/// Steps do not grow beyond this contraction: at one, rounding would.
const MOST_CONTRACTION: f64 = 0.7;

/// Steps of the scale on an octave.
const SCALE: f64 = 16.0;

/// The next factor below on a geometric scale. Estimates of errors are differences, whose rounding would go on to all
/// steps; so it goes on only where it tips the scale.
fn on_scale(factor: f64) -> f64 {
    ((SCALE * factor.log2() + 1e-6).floor() / SCALE).exp2()
}

impl Exponential {
    /// Ratio of the next step size that keeps an error of order `order` at the tolerance.
    fn growth(&self, error: f64, order: usize, bias: f64) -> f64 {
        1.0 / ((bias * error / self.tolerance).powf(1.0 / (order as f64 + 1.5)) + 1e-6)
    }

    /// After an attempt that was thrown away.
    pub(super) fn fail(&mut self, factor: f64) {
        self.limited += LIMITED;
        self.pace.fail(on_scale(factor));
    }

    /// What a second correction would change of the candidate, over what the first one did.
    pub(super) fn contraction(&mut self) -> f64 {
        let [mut weights, mut constant] = [[0.0; MOST_MOMENTS]; 2];
        (weights[0], constant[0]) = (1.0, 1.0);
        self.change(&[Correction { points: 1, weights, terms: 1, polynomial: constant }]);
        let again = self.norm.norm(&self.changes[0]);
        self.scratch.iter_mut().zip(&self.candidate).zip(&self.predicted).for_each(|((d, y), p)| *d = y - p);
        again / self.norm.norm(&self.scratch).max(f64::MIN_POSITIVE)
    }

    /// Numbers of values of N whose differences tell the error at this order, and at its neighbours where the order may change
    /// after this step.
    pub(super) fn watched(&self) -> [usize; MOST_CHANGES - 1] {
        let order = self.pace.order;
        let neighbours = if self.pace.steps_at_order >= order { [order - 1, order + 2] } else { [0, 0] };
        [order, order + 1, neighbours[0], neighbours[1]]
    }

    /// Whether the error of the candidate is below the tolerance; what it would be at other orders.
    pub(super) fn judge(&mut self) -> Result<(), Rejection> {
        let order = self.pace.order;
        let error = self.error(order).unwrap_or(f64::NAN);
        if error <= self.tolerance {
            return Ok(());
        }
        let growth = if error.is_finite() { self.growth(error, order, BIAS[1]) } else { 0.0 };
        self.fail(growth.clamp(0.2, 0.9));
        Err(Rejection::Error)
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
    pub(super) fn plan(&mut self, contraction: f64) {
        let order = self.pace.order;
        let mut best = (order, self.error(order).map_or(0.0, |error| self.growth(error, order, BIAS[1])));
        if self.pace.steps_at_order > order {
            for (other, bias) in [(order - 1, BIAS[0]), (order + 1, BIAS[2])] {
                let Some(error) = self.error(other) else { continue };
                let growth = self.growth(error, other, bias);
                if growth > best.1 {
                    best = (other, growth);
                }
            }
        }
        best.1 = best.1.min(MOST_CONTRACTION / contraction);
        self.pace.go_on(best, on_scale);
    }
}
