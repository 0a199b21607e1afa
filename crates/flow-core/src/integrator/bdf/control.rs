//! Order and size of the next step.

use super::{Bdf, HIGHEST_ORDER};

/// Safety factors on the error of order k − 1, k, k + 1: a change of order must pay.
const BIAS: [f64; 3] = [4.0, 4.0, 6.0];
impl Bdf {
    /// Estimate of the local error of order `order` at constant step: ‖h^{k+1} y^{(k+1)}‖/(k + 1).
    fn error_of_order(&mut self, order: usize) -> f64 {
        let time = self.candidate_time();
        let weights = self.predictor(order, 0);
        self.history.combine(&weights.value, order + 1, &mut self.difference);
        for (difference, y) in self.difference.iter_mut().zip(&self.candidate) {
            *difference = y - *difference;
        }
        let mut factor = 1.0 / (order + 1) as f64;
        for back in 0..=order {
            factor *= self.pace.step / (time - self.history.times()[back]) * (back + 1) as f64;
        }
        factor * self.norm.norm(&self.difference)
    }

    /// Ratio of the next step size that keeps an error at the tolerance.
    pub(super) fn growth(&self, error: f64, order: usize, bias: f64) -> f64 {
        1.0 / ((bias * error / self.tolerance).powf(1.0 / (order + 1) as f64) + 1e-6)
    }

    /// Order and step size after an accepted candidate (which is not yet in the history).
    pub(super) fn plan(&mut self) {
        let order = self.pace.order;
        let error = self.error_of_order(order);
        let mut best = (order, self.growth(error, order, BIAS[1]));
        if self.pace.steps_at_order > order {
            if order > 1 {
                let lower = self.error_of_order(order - 1);
                let growth = self.growth(lower, order - 1, BIAS[0]);
                if growth > best.1 {
                    best = (order - 1, growth);
                }
            }
            if order < HIGHEST_ORDER && self.history.len() > order + 1 {
                let higher = self.error_of_order(order + 1);
                let growth = self.growth(higher, order + 1, BIAS[2]);
                if growth > best.1 {
                    best = (order + 1, growth);
                }
            }
        }
        self.pace.go_on(best, |factor| factor);
    }
}
