//! Integrals over time of quantities known at the accepted steps, by polynomials through their last values
//! (an implicit Adams formula with variable steps) in the time of the clock of the step; that of a positive rate by a polynomial in
//! its logarithm. See `THEORY.md`, eq. (I6).

use serde::{Deserialize, Serialize};

use super::clock::stretched;

/// Number of integrals that are carried along with the state.
pub const INTEGRALS: usize = 4;
/// Values that a polynomial goes through at most.
const POINTS: usize = 7;
/// … and at least, once there are so many.
const FEWEST_OF_MANY: usize = 5;
/// Index of ∫ dissipation dt among them, the one whose rate is never negative.
pub const DISSIPATED: usize = 0;
/// Logarithm by which an interpolated positive rate may leave the range of the two rates beside it.
const LEAST_SWING: f64 = 0.1;
/// … and the most, a factor of a thousand.
const MOST_SWING: f64 = 6.9;
/// The clock of the step must run at the points: 1 + c(t − t₀) is above this.
const LEAST_RUN: f64 = 0.02;
/// Nodes and weights of the four-point Gauss rule on [0, 1], exact for the polynomials used.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_2, 0.173_927_422_568_726_93),
];

/// The integrals with the history of their rates, newest first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Integrals {
    times: [f64; POINTS],
    rates: [[f64; INTEGRALS]; POINTS],
    filled: usize,
    /// How many of them the polynomials go through at most.
    most: usize,
    /// Rate of the clock of the last step, from its start.
    stretch: f64,
    /// Values at the last and at the time before.
    values: [[f64; INTEGRALS]; 2],
}

impl Integrals {
    /// Integrals with the values `values` at `time`, where the rates are `rates`.
    #[must_use]
    pub fn new(time: f64, values: [f64; INTEGRALS], rates: [f64; INTEGRALS]) -> Self {
        Self {
            times: [time; POINTS],
            rates: [rates; POINTS],
            filled: 1,
            most: FEWEST_OF_MANY,
            stretch: 0.0,
            values: [values; 2],
        }
    }

    /// Takes polynomials through as many values as a step of order `order` has use for: with fewer, the balance of energy and
    /// dissipation would limit steps of high order; with more, those of low order swing.
    pub fn serve_order(&mut self, order: usize) {
        self.most = order.clamp(FEWEST_OF_MANY, POINTS);
    }

    fn used(&self) -> usize {
        self.filled.min(self.most)
    }

    /// Whether the numbers belong together.
    #[must_use]
    pub(super) fn is_sound(&self) -> bool {
        let rates = self.rates.iter().chain(&self.values).flatten();
        (1..=POINTS).contains(&self.filled)
            && (FEWEST_OF_MANY..=POINTS).contains(&self.most)
            && rates.chain(&self.times).chain([&self.stretch]).all(|value| value.is_finite())
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

    /// Those at the end of a step to `time`, with the rates there; the clock of the step has the rate `stretch` from its start on.
    #[must_use]
    pub fn after(&self, time: f64, rates: [f64; INTEGRALS], stretch: f64) -> Self {
        let mut after = self.clone();
        after.times.rotate_right(1);
        after.rates.rotate_right(1);
        after.times[0] = time;
        after.rates[0] = rates;
        after.filled = (self.filled + 1).min(POINTS);
        after.stretch = stretch;
        after.values[1] = self.values[0];
        after.values[0] = after.at(time);
        after
    }

    /// Goes to a new time without a change: rates before it say nothing of those after.
    pub fn hold(&mut self, time: f64) {
        *self = Self::new(time, self.values[0], [0.0; INTEGRALS]);
    }

    /// Values at a time within the last step.
    #[must_use]
    pub fn at(&self, time: f64) -> [f64; INTEGRALS] {
        if self.filled < 2 {
            return self.values[0];
        }
        let start = self.times[1];
        let runs = |time: &&f64| 1.0 + self.stretch * (*time - start) > LEAST_RUN;
        let used = self.times[..self.used()].iter().take_while(runs).count();
        let mut values = self.values[1];
        let rates = &self.rates[..used];
        let times = &self.times[..used];
        // In units of the step: products of differences of times alone may underflow.
        let step = times[0] - start;
        let run = self.stretch * step;
        let scale = |time: f64| stretched(run, (time - start) / step);
        let mut scaled = self.times;
        for time in &mut scaled {
            *time = scale(*time);
        }
        // A rate that falls by decades within a few steps is a polynomial in its logarithm only.
        let logarithmic = rates.iter().all(|r| r[DISSIPATED] > 0.0);
        let mut scaled_rates = self.rates;
        if logarithmic {
            scaled_rates[..used].iter_mut().for_each(|r| r[DISSIPATED] = r[DISSIPATED].ln());
        }
        let points = &scaled[..used];
        let factors = lagrange_factors(points);
        for (node, weight) in GAUSS {
            let weights = lagrange_values(scale(start + node * (time - start)), points, &factors);
            let mut sums = [0.0; INTEGRALS];
            for (rates, weight) in scaled_rates[..used].iter().zip(weights) {
                for (sum, rate) in sums.iter_mut().zip(rates) {
                    *sum += weight * rate;
                }
            }
            for (i, (value, sum)) in values.iter_mut().zip(sums).enumerate() {
                let ends = [scaled_rates[0][i], scaled_rates[1][i]];
                let rate = match i {
                    DISSIPATED if logarithmic => near(sum, ends, LEAST_SWING).exp(),
                    DISSIPATED => sum.min(2.0 * ends[0].max(ends[1])).max(0.0),
                    _ => sum,
                };
                *value += (time - start) * weight * rate;
            }
        }
        values
    }
}

/// 1/∏(pⱼ − pᵢ) of each of the `points`.
fn lagrange_factors(points: &[f64]) -> [f64; POINTS] {
    let mut factors = [1.0; POINTS];
    for (j, (factor, point)) in factors.iter_mut().zip(points).enumerate() {
        let others = points.iter().enumerate().filter(|(i, _)| *i != j);
        *factor = 1.0 / others.map(|(_, other)| point - other).product::<f64>();
    }
    factors
}

/// Values at `x` of the Lagrange polynomials of `points`: products of the distances before and after each.
fn lagrange_values(x: f64, points: &[f64], factors: &[f64; POINTS]) -> [f64; POINTS] {
    let mut values = *factors;
    let (mut before, mut after) = (1.0, 1.0);
    for (value, point) in values.iter_mut().zip(points) {
        *value *= before;
        before *= x - point;
    }
    for (value, point) in values[..points.len()].iter_mut().zip(points).rev() {
        *value *= after;
        after *= x - point;
    }
    values
}

/// `value`, but no farther outside the range of `ends` than the range is wide and `least` more: a polynomial through
/// values that jump between steps of unequal size swings beyond them, and in a logarithm that means powers of ten.
fn near(value: f64, ends: [f64; 2], least: f64) -> f64 {
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let margin = (high - low + least).min(MOST_SWING);
    value.clamp(low - margin, high + margin)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(times: &[f64], rate: impl Fn(f64) -> f64) -> f64 {
        integral_by(|_| 0.0, times, rate)
    }

    /// By a clock whose rate from each of the times on is `stretch`.
    fn integral_by(stretch: impl Fn(f64) -> f64, times: &[f64], rate: impl Fn(f64) -> f64) -> f64 {
        let rates = |time| [rate(time), 0.0, 0.0, 0.0];
        let mut integrals = Integrals::new(times[0], [0.0; INTEGRALS], rates(times[0]));
        for step in times.windows(2) {
            integrals = integrals.after(step[1], rates(step[1]), stretch(step[0]));
        }
        integrals.values()[DISSIPATED]
    }

    #[test]
    fn a_rate_that_decays_is_integrated_exactly() {
        let times: Vec<f64> = (0..40).map(|i| 0.25 * f64::from(i)).collect();
        let exact = 1.0 - (-9.75_f64).exp();
        assert!((integral(&times, |time| (-time).exp()) - exact).abs() < 1e-9); // the Gauss rule
    }

    #[test]
    fn a_rate_that_falls_by_a_power_of_the_time_is_integrated_by_a_clock_that_starts_with_it() {
        let times: Vec<f64> = std::iter::once(0.0).chain((0..30).map(|i| 1e-8 * 1.8_f64.powi(i))).collect();
        let rate = |time: f64| (time + 3e-8).powf(-0.6);
        let end = times.last().unwrap() + 3e-8;
        let exact = (end.powf(0.4) - 3e-8_f64.powf(0.4)) / 0.4;
        let got = integral_by(|time| 1.0 / (time + 3e-8), &times, rate);
        assert!((got / exact - 1.0).abs() < 1e-5, "{}", got / exact - 1.0);
        assert!((integral(&times, rate) / exact - 1.0).abs() > 1e-2);
    }

    #[test]
    fn steps_that_shrink_to_the_rounding_of_the_time_and_grow_again_are_integrated() {
        let mut times = vec![0.0, 1e-15, 1e-12];
        for i in 0..12 {
            times.push(times[times.len() - 1] + 1e-27 * 2.5_f64.powi(i));
        }
        let got = integral(&times, |_| 2.0);
        assert!((got / (2.0 * times[times.len() - 1]) - 1.0).abs() < 1e-13, "{got}");
    }

    #[test]
    fn a_rate_that_jumps_gives_no_more_than_its_values_allow() {
        let times: Vec<f64> = (0..40).map(|i| 1e-9 * 2.5_f64.powi(i)).collect();
        let noisy = |time: f64| if (1e9 * time).log(2.5).round() as i64 % 3 == 0 { 1e-3 } else { 1e-15 };
        let bound: f64 = times.windows(2).map(|pair| 1e3 * (pair[1] - pair[0])).sum();
        assert!(integral(&times, noisy).is_finite());
        assert!(integral(&times, noisy) <= bound, "{:e}", integral(&times, noisy));
    }

    /// Rates of zero, as at rest, have no logarithm, and polynomials through a jump of them swing.
    #[test]
    fn a_rate_that_jumps_from_zero_gives_no_less_than_nothing_and_no_more_than_its_values_allow() {
        let times = [0.0, 1.0, 2.0, 2.001, 10.0];
        for rates in [
            [0.0, 0.0, 0.0, 1.0, 1.0],
            [0.0, 0.0, 0.0, 1.0, 0.0],
            [1.0, 1.0, 1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 1.0, 0.0],
        ] {
            let mut integrals = Integrals::new(times[0], [0.0; INTEGRALS], [rates[0], 0.0, 0.0, 0.0]);
            for step in 1..times.len() {
                let after = integrals.after(times[step], [rates[step], 0.0, 0.0, 0.0], 0.0);
                let more = after.values()[DISSIPATED] - integrals.values()[DISSIPATED];
                let most = 2.0 * (times[step] - times[step - 1]) * rates[step].max(rates[step - 1]);
                assert!(more >= 0.0 && more <= 1.0001 * most, "{rates:?}: {more} in step {step}");
                integrals = after;
            }
        }
    }
}
