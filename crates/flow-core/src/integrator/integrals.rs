//! Integrals over time of quantities known at the accepted steps, by polynomials through their last values
//! (an implicit Adams formula with variable steps); that of a positive rate by a polynomial in its logarithm. See `THEORY.md`, eq. (I6).

use serde::{Deserialize, Serialize};

use super::INTEGRALS;
use super::history::lagrange;

/// Values that a polynomial goes through.
const POINTS: usize = 5;
/// The integral whose rate is never negative.
const POSITIVE: usize = 0;
/// Nodes and weights of the three-point Gauss rule on [0, 1], exact for the polynomials used.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// The integrals with the history of their rates, newest first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Integrals {
    times: [f64; POINTS],
    rates: [[f64; INTEGRALS]; POINTS],
    filled: usize,
    /// Values at the last and at the time before.
    values: [[f64; INTEGRALS]; 2],
}

impl Integrals {
    /// Integrals with the values `values` at `time`, where the rates are `rates`.
    #[must_use]
    pub fn new(time: f64, values: [f64; INTEGRALS], rates: [f64; INTEGRALS]) -> Self {
        Self { times: [time; POINTS], rates: [rates; POINTS], filled: 1, values: [values; 2] }
    }

    /// Whether the numbers belong together.
    #[must_use]
    pub(super) fn is_sound(&self) -> bool {
        let rates = self.rates.iter().chain(&self.values).flatten();
        (1..=POINTS).contains(&self.filled) && rates.chain(&self.times).all(|value| value.is_finite())
    }

    /// The last time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.times[0]
    }

    /// Values at the last time.
    #[must_use]
    pub fn values(&self) -> [f64; INTEGRALS] {
        self.values[0]
    }

    /// Takes the rates at a new time.
    pub fn push(&mut self, time: f64, rates: [f64; INTEGRALS]) {
        self.times.rotate_right(1);
        self.rates.rotate_right(1);
        self.times[0] = time;
        self.rates[0] = rates;
        self.filled = (self.filled + 1).min(POINTS);
        self.values[1] = self.values[0];
        self.values[0] = self.at(time);
    }

    /// Values at a time within the last step.
    #[must_use]
    pub fn at(&self, time: f64) -> [f64; INTEGRALS] {
        if self.filled < 2 {
            return self.values[0];
        }
        let start = self.times[1];
        let mut values = self.values[1];
        let rates = &self.rates[..self.filled];
        // A rate that falls by decades within a few steps is a polynomial in its logarithm only.
        let logarithmic: [bool; INTEGRALS] =
            std::array::from_fn(|i| i == POSITIVE && rates.iter().all(|r| r[i] > 0.0));
        for (node, weight) in GAUSS {
            let weights = lagrange(start + node * (time - start), &self.times[..self.filled]).value;
            for (i, value) in values.iter_mut().enumerate() {
                let sum =
                    |of: fn(f64) -> f64| rates.iter().zip(weights).map(|(r, w)| w * of(r[i])).sum::<f64>();
                let rate = if logarithmic[i] { sum(f64::ln).exp() } else { sum(|rate| rate) };
                *value += (time - start) * weight * rate;
            }
        }
        values
    }
}
