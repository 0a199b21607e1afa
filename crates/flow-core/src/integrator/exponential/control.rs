//! Order and size of the next step, and the watch over what limits it.

use super::{Exponential, HIGHEST_ORDER};
use crate::geometry::vectors::add_scaled;
use crate::integrator::history::lagrange;

/// Safety factors on the error of order k − 1, k, k + 1: a change of order must pay.
const BIAS: [f64; 3] = [3.0, 2.0, 3.0];
/// Growth below this factor is not worth new moments.
const LEAST_GROWTH: f64 = 1.2;
/// Growth of a step at most.
pub(super) const MOST_GROWTH: f64 = 2.5;
const FIRST_GROWTH: f64 = 1e4;
/// Contraction of the corrector above which what it leaves out, the stiffness of N, limits the steps.
const STIFF: f64 = 0.4;

impl Exponential {
    /// Ratio of the next step size that keeps an error at the tolerance.
    pub(super) fn growth(&self, error: f64, order: usize, bias: f64) -> f64 {
        1.0 / ((bias * error / self.tolerance).powf(1.0 / (order + 1) as f64) + 1e-6)
    }

    /// After an attempt that was thrown away.
    pub(super) fn fail(&mut self, factor: f64) {
        self.failures += 1;
        self.limited += 1;
        self.step *= factor;
        if self.failures > 2 && self.order > 1 {
            self.order -= 1;
            self.steps_at_order = 0;
        }
    }

    /// Whether a second correction would change the candidate by much of what the first one did.
    pub(super) fn is_limited(&mut self) -> bool {
        let Self { missed, rests, predicted_rest, .. } = self;
        missed.iter_mut().zip(&rests[0]).zip(&*predicted_rest).for_each(|((missed, now), then)| *missed = now - then);
        let mut constant = [0.0; super::MOST_MOMENTS];
        constant[0] = 1.0;
        self.integrate(&constant, 0);
        let again = self.norm.norm(&self.scratch);
        self.scratch.iter_mut().zip(&self.candidate).zip(&self.predicted).for_each(|((d, y), p)| *d = y - p);
        again > STIFF * self.norm.norm(&self.scratch)
    }

    /// Estimate of the error that the step would have had at order `order`.
    fn error_of_order(&mut self, order: usize) -> f64 {
        let nodes = self.nodes(order);
        let weights = lagrange(1.0, &nodes[..order]).value;
        self.missed.copy_from_slice(&self.predicted_rest);
        // The newest of the values is that of the candidate, which is not yet in the history of states.
        for (weight, rest) in weights[..order].iter().zip(&self.rests[1..]) {
            add_scaled(&mut self.missed, -weight, rest);
        }
        self.error(order)
    }

    /// Order and step size after an accepted candidate (which is not yet in the history of states).
    pub(super) fn plan(&mut self) {
        let order = self.order;
        let mut best = (order, self.growth(self.own_error, order, BIAS[1]));
        if self.steps_at_order > order {
            if order > 1 {
                let lower = self.error_of_order(order - 1);
                let growth = self.growth(lower, order - 1, BIAS[0]);
                if growth > best.1 {
                    best = (order - 1, growth);
                }
            }
            if order < HIGHEST_ORDER && self.states.len() > order {
                let higher = self.error_of_order(order + 1);
                let growth = self.growth(higher, order + 1, BIAS[2]);
                if growth > best.1 {
                    best = (order + 1, growth);
                }
            }
        }
        let most = if self.accepted == 0 { FIRST_GROWTH } else { MOST_GROWTH };
        let mut growth = best.1.min(most);
        if self.failures > 0 {
            growth = growth.min(1.0);
        }
        if growth > 1.0 && growth < LEAST_GROWTH {
            growth = 1.0;
            best.0 = order;
        }
        if best.0 != order {
            self.steps_at_order = 0;
        }
        self.order = best.0;
        self.step *= growth.max(0.5);
    }
}
