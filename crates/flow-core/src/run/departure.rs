//! Whether a flow that seems to be at rest is leaving. See `THEORY.md`, eq. (I7).

use serde::{Deserialize, Serialize};

/// Marks that are kept at most; then every second one goes.
const MOST_MARKS: usize = 9;
/// Rates, each above the one before, that tell a growth from noise.
const RATES: usize = 4;

/// What a quiet flow has lost at some times, as many steps apart each.
///
/// Near a saddle the dissipation goes through a minimum, and then grows exponentially: what is small now may be all that is to come.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Times, and the energy lost until then since the first.
    marks: Vec<(f64, f64)>,
    /// Steps from mark to mark.
    spacing: u32,
    /// Steps since the last mark.
    since: u32,
}

impl Departure {
    /// Since `time`.
    #[must_use]
    pub fn since(time: f64) -> Self {
        Self { marks: vec![(time, 0.0)], spacing: 1, since: 0 }
    }

    /// Takes a step to `time`, until which `lost` has been lost in all.
    pub fn take(&mut self, time: f64, lost: f64) {
        self.since += 1;
        if self.since < self.spacing {
            return;
        }
        self.since = 0;
        self.marks.push((time, lost));
        if self.marks.len() > MOST_MARKS {
            let mut index = 0;
            self.marks.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing *= 2;
        }
    }

    /// What is lost in the time `left` if the losses go on to grow as they have all the while; 0 if they have not.
    #[must_use]
    pub fn to_come(&self, left: f64) -> f64 {
        let rates = self.marks.windows(2).map(|pair| {
            let [(start, before), (end, after)] = [pair[0], pair[1]];
            (0.5 * (start + end), (after - before) / (end - start))
        });
        let rates: Vec<(f64, f64)> = rates.collect();
        let grows = rates.len() >= RATES && rates.windows(2).all(|pair| pair[1].1 > pair[0].1);
        let (Some(first), Some(last)) = (rates.first(), rates.last()) else { return 0.0 };
        if !grows || first.1 <= 0.0 {
            return 0.0;
        }
        let growth = (last.1 / first.1).ln() / (last.0 - first.0);
        last.1 * (growth * left).exp_m1() / growth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a flow whose rate is `rate` at each of so many steps is thought to lose in a time of 10 more.
    fn to_come(steps: u32, rate: impl Fn(f64) -> f64) -> f64 {
        let (mut departure, mut lost) = (Departure::since(0.0), 0.0);
        for step in 1..=steps {
            let time = f64::from(step);
            lost += rate(time - 0.5);
            departure.take(time, lost);
        }
        departure.to_come(10.0)
    }

    #[test]
    fn an_exponential_growth_goes_on() {
        for steps in [4, 8, 64, 256] {
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
}
