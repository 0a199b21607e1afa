//! Proportional–integral control of the step size. Hairer & Wanner, Solving ODEs II (1996), section IV.2.

const SAFETY: f64 = 0.9;
const INTEGRAL: f64 = 0.7;
const PROPORTIONAL: f64 = 0.4;
const LEAST: f64 = 0.2;
const MOST: f64 = 5.0;
/// Growth allowed after the first step, whose size is a guess.
const FIRST_MOST: f64 = 100.0;

/// The controller with its memory of the last error.
#[derive(Clone, Debug)]
pub struct Controller {
    /// Power of the step size in the error.
    exponent: f64,
    last: Option<f64>,
}

impl Controller {
    /// For an error estimate of order `embedded_order`.
    #[must_use]
    pub fn new(embedded_order: usize) -> Self {
        Self { exponent: 1.0 / (embedded_order + 1) as f64, last: None }
    }

    /// Factor on the step size after a step with `error`, relative to the tolerance, below 1.
    pub fn accepted(&mut self, error: f64, after_failure: bool) -> f64 {
        let error = error.max(1e-10);
        let most = if self.last.is_none() { FIRST_MOST } else { MOST };
        let last = self.last.unwrap_or(1.0);
        self.last = Some(error.max(1e-4));
        let factor = SAFETY * error.powf(-INTEGRAL * self.exponent) * last.powf(PROPORTIONAL * self.exponent);
        factor.clamp(LEAST, if after_failure { 1.0 } else { most })
    }

    /// Factor on the step size after a step with `error` above 1.
    #[must_use]
    pub fn rejected(&self, error: f64) -> f64 {
        (SAFETY * error.powf(-self.exponent)).clamp(LEAST, 0.9)
    }
}
