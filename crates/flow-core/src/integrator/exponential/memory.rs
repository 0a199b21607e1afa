//! What it takes for the method to go on.

use serde::{Deserialize, Serialize};

use super::blocked::Blocked;
use super::control::Stiffness;
use super::orders::{HIGHEST_ORDER, MOST_MOMENTS};
use super::{Exponential, Moments, OLDEST_PART, StepClock, Substitution};
use crate::integrator::Problem;
use crate::integrator::error_norm::ErrorNorm;
use crate::integrator::history::{History, MOST_POINTS};
use crate::integrator::linear_part::LinearPart;
use crate::integrator::memory::Memory;
use crate::integrator::newton::Factorisation;

/// Local errors may be as large as a tolerance of 1e-5, flows that are unstable for a while magnifying each of them; smaller, by the one power,
/// with a tighter tolerance, whose errors add up over more steps, and larger, by the other, with one that takes a few steps only.
const TIGHT: (f64, f64) = (1e-5, 0.15);
const LOOSE: (f64, f64) = (1e-3, 0.5);

/// Local error for which the global error is about the tolerance.
fn local_tolerance(tolerance: f64) -> f64 {
    let tight = (tolerance / TIGHT.0).min(1.0).powf(TIGHT.1);
    tolerance * tight * (tolerance / LOOSE.0).max(1.0).powf(LOOSE.1)
}

/// Count of steps that the stiffness of the rest has limited, at which an implicit method takes over.
pub(super) const ENOUGH: u32 = 16 * super::control::LIMITED;

/// What the exponential method knows besides past states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExponentialMemory {
    /// Rates at the past states.
    pub rates: Vec<Vec<f64>>,
    pub(super) part: LinearPart,
    pub(super) part_age: usize,
    pub(super) stiffness: Stiffness,
}

impl ExponentialMemory {
    /// Of a method that has taken Λ = `part` from its last state, with the rates at its states.
    pub(super) fn new(rates: Vec<Vec<f64>>, part: LinearPart) -> Self {
        Self { rates, part, part_age: 0, stiffness: Stiffness::default() }
    }

    /// Takes Λ anew from `problem` at `state`; false if it has none.
    pub fn renew(&mut self, problem: &mut dyn Problem, state: &[f64]) -> bool {
        self.part_age = 0;
        problem.linear_part(state, &mut self.part)
    }

    /// Whether it belongs to `points` states of `size` entries.
    pub(in crate::integrator) fn fits(&self, points: usize, size: usize) -> bool {
        let sound = |rate: &Vec<f64>| rate.len() == size && rate.iter().all(|value| value.is_finite());
        self.rates.len() == points
            && self.rates.iter().all(sound)
            && self.part.fits(size)
            && self.stiffness.is_sound()
    }
}

impl Exponential {
    /// Goes on from `memory` and `own`, to the same local errors as before if `tolerance` is the same.
    #[must_use]
    pub fn resume(problem: &dyn Problem, memory: Memory, own: ExponentialMemory, tolerance: f64) -> Self {
        let size = problem.size();
        let (zero, blocked) = (|| vec![0.0; size], || Blocked::new(size));
        let times = memory.points.iter().map(|(time, _)| *time);
        let rates: Vec<_> = times.zip(own.rates).collect();
        let mut method = Self {
            states: History::of(size, &memory.points),
            rates: History::of(size, &rates),
            integrals: memory.integrals,
            norm: ErrorNorm::new(problem),
            tolerance: local_tolerance(tolerance),
            next_part: own.part.clone(),
            part: own.part,
            part_age: own.part_age.min(OLDEST_PART),
            moments: Moments::new(size),
            substitution: Substitution::new(StepClock::new(0.0), 1),
            nodes: [0.0; MOST_MOMENTS],
            best_stretch: 0.0,
            rests: vec![blocked(); MOST_POINTS],
            bases: [blocked(), blocked()],
            pace: memory.pace.of_order_at_most(HIGHEST_ORDER),
            stiffness: own.stiffness,
            differences: [None; MOST_POINTS + 1],
            predicted: blocked(),
            candidate: zero(),
            predicted_rest: blocked(),
            candidate_rate: zero(),
            candidate_rest: blocked(),
            candidate_base: blocked(),
            changes: std::array::from_fn(|_| blocked()),
            scratch: zero(),
        };
        method.decompose();
        method
    }

    /// What it takes to go on from here.
    #[must_use]
    pub fn memory(&self) -> Memory {
        let rates = self.rates.points().into_iter().map(|(_, rate)| rate).collect();
        Memory {
            points: self.states.points(),
            integrals: self.integrals.clone(),
            factorisation: Factorisation::default(),
            exponential: Some(ExponentialMemory {
                rates,
                part: self.part.clone(),
                part_age: self.part_age,
                stiffness: self.stiffness,
            }),
            pace: self.pace,
        }
    }

    /// Whether the stiffness of the rest has limited so many steps that an implicit method would do better.
    #[must_use]
    pub fn is_exhausted(&self) -> bool {
        self.stiffness.limited >= ENOUGH
    }
}
