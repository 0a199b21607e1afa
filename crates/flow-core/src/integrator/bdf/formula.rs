//! The coefficients of a step.

use super::Bdf;
use crate::integrator::clock::Clock;
use crate::integrator::history::{MOST_POINTS, Weights, lagrange};

impl Bdf {
    pub(super) fn leading_coefficient(&self) -> f64 {
        (1..=self.pace.order).map(|i| 1.0 / i as f64).sum()
    }

    /// The clock of the next step.
    pub(super) fn clock(&self) -> Clock {
        self.pace.clock(self.history.times())
    }

    /// γ = h/α of the stage y = a + γf(y).
    pub(super) fn gamma(&self) -> f64 {
        let (clock, end) = (self.clock(), self.candidate_time());
        clock.at(end) * clock.slope(end) / self.leading_coefficient()
    }

    pub(super) fn candidate_time(&self) -> f64 {
        self.history.times()[0] + self.pace.step
    }

    /// τ by `clock` at the end of the step, and at the past states.
    pub(super) fn stretched(&self, clock: Clock) -> (f64, [f64; MOST_POINTS]) {
        (clock.at(self.candidate_time()), clock.all(self.history.times()))
    }

    /// Of the polynomial in τ through the last states, at the end of the step; the derivative by the time.
    pub(super) fn predictor(&self, order: usize, clock: Clock) -> Weights {
        let ((end, times), slope) = (self.stretched(clock), clock.slope(self.candidate_time()));
        let mut weights = lagrange(end, &times[..=order]);
        weights.derivative.iter_mut().for_each(|weight| *weight /= slope);
        weights
    }
}
