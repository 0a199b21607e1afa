//! What a multistep method must know to go on as if it had never stopped.

use serde::{Deserialize, Serialize};

use super::bdf;
use super::exponential::ExponentialMemory;
use super::history::MOST_POINTS;
use super::integrals::{INTEGRALS, Integrals};
use super::newton::Factorisation;
use super::pace::Pace;

/// Past states, integrals, step size and order; the rest is computed anew in every step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Times and states, newest first.
    pub points: Vec<(f64, Vec<f64>)>,
    /// The integrals carried along.
    pub integrals: Integrals,
    /// Age of the factorisation.
    pub factorisation: Factorisation,
    /// What the exponential method knows besides, if it is the one that goes on.
    pub exponential: Option<ExponentialMemory>,
    pub(super) pace: Pace,
}

impl Memory {
    /// Whether a method can go on from it with states of `size` entries.
    #[must_use]
    pub fn fits(&self, size: usize) -> bool {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let falling = self.points.windows(2).all(|pair| pair[0].0 > pair[1].0);
        let points = self.points.len();
        let orders = 1..MOST_POINTS;
        let times: Vec<f64> = self.points.iter().map(|(time, _)| *time).collect();
        let enough = match &self.exponential {
            Some(own) => own.fits(points, size) && points >= self.pace.order.max(2),
            None => points > self.pace.order.max(self.pace.last_order) && self.pace.order < MOST_POINTS - 1,
        };
        falling
            && self.integrals.is_sound()
            && (1..=MOST_POINTS).contains(&points)
            && self
                .points
                .iter()
                .all(|(time, state)| time.is_finite() && state.len() == size && finite(state))
            && orders.contains(&self.pace.order)
            && orders.contains(&self.pace.last_order)
            && enough
            && self.pace.fits(&times)
            && self.pace.step > 0.0
            && self.pace.step.is_finite()
    }

    /// For the implicit method to go on from here.
    #[must_use]
    pub fn implicit(mut self) -> Self {
        if self.exponential.take().is_none() {
            return self;
        }
        let most = bdf::HIGHEST_ORDER.min(self.points.len() - 1);
        self.pace = Pace { steps_at_order: 0, ..self.pace.of_order_at_most(most) };
        self
    }

    /// For who goes no further than a `time` within the last step: it ends there, in `state` and with these `integrals`.
    #[must_use]
    pub fn ended_at(self, time: f64, state: &[f64], integrals: [f64; INTEGRALS]) -> Self {
        let mut ended = self.implicit();
        if let Some(newest) = ended.points.first_mut() {
            *newest = (time, state.to_vec());
        }
        ended.integrals = Integrals::new(time, integrals, [0.0; INTEGRALS]);
        ended.factorisation = Factorisation::default();
        ended
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn past_states_out_of_order_are_those_of_no_run() {
        let fits = |times: [f64; 3]| {
            let mut pace = Pace::starting(0.1);
            (pace.order, pace.last_order) = (2, 2);
            let points = times.map(|time| (time, vec![1.0])).to_vec();
            let integrals = Integrals::new(0.0, [0.0; INTEGRALS], [0.0; INTEGRALS]);
            let factorisation = Factorisation::default();
            Memory { points, integrals, factorisation, exponential: None, pace }.fits(1)
        };
        assert!(fits([0.0, -0.1, -0.2]));
        for times in [[0.0, -0.2, -0.1], [0.0, -0.1, -0.1], [-0.1, 0.0, -0.2], [0.0, f64::NAN, -0.1]] {
            assert!(!fits(times), "{times:?}");
        }
    }
}
