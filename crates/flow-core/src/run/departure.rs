//! Whether a flow that seems to be at rest is leaving. See `THEORY.md`, eq. (I7).

use serde::{Deserialize, Serialize};

/// So many marks are thinned: every second one goes, the first and the last stay.
const MOST_MARKS: usize = 9;
/// Rates, each above the one before, that tell a growth from noise.
const RATES: usize = 4;
/// A rate that is so many times all before it tells one too: those may have been noise.
const SURGE: f64 = 10.0;

/// What a quiet flow has lost at some times, as many steps apart each.
///
/// Near a saddle the dissipation goes through a minimum, and then grows exponentially: what is small now may be all that is to come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Times, and the energy lost until then since the first.
    marks: Vec<(f64, f64)>,
    /// Steps from mark to mark.
    spacing: u32,
    /// Steps since the last mark.
    since: u32,
}

impl Departure {
    /// Without a mark: steps do not allocate.
    #[must_use]
    pub fn new() -> Self {
        Self { marks: Vec::with_capacity(MOST_MARKS), spacing: 1, since: 0 }
    }

    /// Begins anew at `time`.
    pub fn begin(&mut self, time: f64) {
        self.marks.clear();
        self.marks.push((time, 0.0));
        (self.spacing, self.since) = (1, 0);
    }

    /// Takes a step to `time`, until which `lost` has been lost in all.
    pub fn take(&mut self, time: f64, lost: f64) {
        self.since += 1;
        if self.since < self.spacing {
            return;
        }
        self.since = 0;
        self.marks.push((time, lost));
        if self.marks.len() == MOST_MARKS {
            let mut index = 0;
            self.marks.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing *= 2;
        }
    }

    /// What is lost in the time `left` if the losses go on to grow as they have all the while, or have done now; 0 if they have not.
    #[must_use]
    pub fn to_come(&self, left: f64) -> f64 {
        let rate = |pair: &[(f64, f64)]| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
        let middle = |pair: &[(f64, f64)]| 0.5 * (pair[0].0 + pair[1].0);
        let pairs = || self.marks.windows(2);
        if pairs().len() < RATES {
            return 0.0;
        }
        let before = || pairs().take(pairs().len() - 1);
        let highest = before().max_by(|a, b| rate(a).total_cmp(&rate(b)));
        let (Some(first), Some(last), Some(highest)) = (pairs().next(), pairs().next_back(), highest) else {
            return 0.0;
        };
        let grows = pairs().map(rate).is_sorted_by(|before, after| before < after);
        let since = if grows && rate(first) > 0.0 {
            first
        } else if rate(highest) > 0.0 && rate(last) > SURGE * rate(highest) {
            highest
        } else {
            return 0.0;
        };
        let growth = (rate(last) / rate(since)).ln() / (middle(last) - middle(since));
        rate(last) * (growth * left).exp_m1() / growth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a flow whose rate is `rate` at each of so many steps is thought to lose in a time of 10 more.
    fn to_come(steps: u32, rate: impl Fn(f64) -> f64) -> f64 {
        let (mut departure, mut lost) = (Departure::new(), 0.0);
        departure.begin(0.0);
        for step in 1..=steps {
            let time = f64::from(step);
            lost += rate(time - 0.5);
            departure.take(time, lost);
        }
        departure.to_come(10.0)
    }

    #[test]
    fn an_exponential_growth_goes_on() {
        for steps in [4, 8, 64, 128] {
            let ratio = to_come(steps, |time| (0.01 * time).exp()) / (0.01 * f64::from(steps)).exp();
            // From the middle between the last two marks on.
            assert!(ratio > 8.0 && ratio < 11.0, "{steps}: {ratio}");
        }
    }

    #[test]
    fn what_does_not_grow_all_the_while_is_none() {
        assert_eq!(to_come(3, |time| time), 0.0);
        assert_eq!(to_come(100, |_| 1.0), 0.0);
        assert_eq!(to_come(100, |time| (-0.01 * time).exp()), 0.0);
        assert_eq!(to_come(100, |time| (time - 50.0).abs()), 0.0);
        assert_eq!(to_come(0, |_| 1.0), 0.0);
    }

    #[test]
    fn a_rate_far_above_the_noise_before_it_tells_a_growth() {
        let noisy = |last: f64| move |time: f64| if time < 5.5 { 1e-9 * (3.0 * time).cos() } else { last };
        assert!(to_come(6, noisy(1e-7)) > 1e3);
        assert!(to_come(6, noisy(2e-9)) == 0.0);
    }
}
