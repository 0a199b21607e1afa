//! Stretched time, in which flows that settle are smooth. See `THEORY.md`, eq. (I4).

use super::history::MOST_POINTS;

/// Rates of clocks, in units of that by which the oldest past state were infinitely long ago: the fastest, the slowest beside that of
/// time itself, and the two that are compared with that.
const FASTEST: f64 = 0.95;
const SLOWEST: f64 = 0.04;
const FIRST: [f64; 2] = [0.25, 0.475];
/// Ratio of the rates that are compared.
const RATIO: f64 = 1.5;
/// Another clock must miss less than this part of what the present one misses.
const KEPT: f64 = 0.9;

/// τ(t) = ln(1 + c(t − t₀))/c, or t − t₀ if the rate c is zero.
///
/// From rough data, and after fronts have met, a flow settles by powers of the time since then. Those are exponentials in the
/// logarithm of that time, and a polynomial in τ, with 1/c the time since then, follows them farther than one in t.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    start: f64,
    rate: f64,
}

impl Clock {
    /// From t₀ = `start` at the rate c = `rate`.
    pub fn new(start: f64, rate: f64) -> Self {
        Self { start, rate }
    }

    /// τ at `time`.
    pub fn at(&self, time: f64) -> f64 {
        let stretched = stretched(self.rate, time - self.start);
        if self.rate == 0.0 { stretched } else { stretched / self.rate }
    }

    /// τ at `times`.
    pub fn all(&self, times: &[f64]) -> [f64; MOST_POINTS] {
        let mut stretched = [0.0; MOST_POINTS];
        stretched.iter_mut().zip(times).for_each(|(stretched, time)| *stretched = self.at(*time));
        stretched
    }

    /// dt/dτ at `time`.
    pub fn slope(&self, time: f64) -> f64 {
        1.0 + self.rate * (time - self.start)
    }
}

/// τ `since` t₀ at the rate c = `rate`, up to the factor 1/c: ln(1 + c(t − t₀)), or t − t₀.
pub fn stretched(rate: f64, since: f64) -> f64 {
    if rate == 0.0 { since } else { (rate * since).ln_1p() }
}

/// The fastest clock that runs at times as long ago as `reach`.
pub fn fastest(reach: f64) -> f64 {
    FASTEST / reach
}

/// Rates to compare with `rate`, with past states as long ago as `reach`.
pub fn others(rate: f64, reach: f64) -> [f64; 2] {
    if rate == 0.0 {
        return FIRST.map(|part| part / reach);
    }
    let slower = rate / RATIO;
    [if slower < SLOWEST / reach { 0.0 } else { slower }, (RATIO * rate).min(fastest(reach))]
}

/// The best of `present` and `others`, rates with how much a polynomial misses in the time of each.
pub fn best(present: (f64, f64), others: impl IntoIterator<Item = (f64, f64)>) -> (f64, f64) {
    let (mut best, mut bound) = (present, KEPT * present.1);
    for other in others {
        if other.1 < bound {
            (best, bound) = (other, other.1);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_itself_is_a_clock_and_the_limit_of_slow_ones() {
        let (time, slow) = (Clock::new(2.0, 0.0), Clock::new(2.0, 1e-9));
        for t in [1.0, 2.0, 3.5] {
            assert_eq!(time.at(t), t - 2.0);
            assert!((slow.at(t) - time.at(t)).abs() < 3e-9);
        }
        assert_eq!(time.slope(7.0), 1.0);
    }

    #[test]
    fn powers_of_the_time_are_exponentials_of_the_clock() {
        let clock = Clock::new(3.0, 0.5); // the time since t = 1
        for t in [1.5_f64, 3.0, 8.0] {
            let (power, exponential) = (((t - 1.0) / 2.0).powf(-0.7), (-0.7 * 0.5 * clock.at(t)).exp());
            assert!((power / exponential - 1.0).abs() < 1e-14);
            let h = 1e-6;
            assert!((2.0 * h / (clock.at(t + h) - clock.at(t - h)) / clock.slope(t) - 1.0).abs() < 1e-8);
        }
    }

    #[test]
    fn all_clocks_run_at_the_past_states() {
        let reach = 0.3;
        for rate in [0.0, 0.01, 1.0, fastest(reach)] {
            for other in others(rate, reach) {
                assert!(Clock::new(0.0, other).at(-reach).is_finite());
            }
        }
        assert_eq!(others(1.01 * SLOWEST / reach, reach)[0], 0.0);
    }

    #[test]
    fn another_clock_must_be_better_by_much() {
        assert_eq!(best((1.0, 1.0), [(0.5, 0.95), (2.0, 0.99)]), (1.0, 1.0));
        assert_eq!(best((1.0, 1.0), [(0.5, 0.8), (2.0, 0.7)]), (2.0, 0.7));
        assert_eq!(best((1.0, f64::NAN), [(0.5, 0.8)]).0, 1.0);
    }
}
