//! Order and size of the steps of a multistep method.

use serde::{Deserialize, Serialize};

/// Growth of a step at most.
pub const MOST_GROWTH: f64 = 2.5;
/// Growth after the first step.
const FIRST_GROWTH: f64 = 1e4;
/// Growth below this factor is not worth what a new step size costs.
const LEAST_GROWTH: f64 = 1.2;
/// Steps shrink by no more than this factor after one that went well.
const LEAST: f64 = 0.5;

/// Order and size of the next step, and how the steps before went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    pub order: usize,
    pub last_order: usize,
    pub step: f64,
    pub steps_at_order: usize,
    /// Accepted steps, and attempts thrown away since the last of them.
    pub accepted: u64,
    pub failures: u32,
}

impl Pace {
    /// At a start, with a first step of size `step`.
    pub fn starting(step: f64) -> Self {
        Self { order: 1, last_order: 1, step, steps_at_order: 0, accepted: 0, failures: 0 }
    }

    /// The same with orders of at most `most`.
    pub fn of_order_at_most(self, most: usize) -> Self {
        Self { order: self.order.min(most), last_order: self.last_order.min(most), ..self }
    }

    /// After an attempt that was thrown away.
    pub fn fail(&mut self, factor: f64) {
        self.failures += 1;
        self.step *= factor;
        if self.failures > 2 && self.order > 1 {
            self.order -= 1;
            self.steps_at_order = 0;
        }
    }

    /// A step is accepted.
    pub fn accept(&mut self) {
        self.last_order = self.order;
        self.steps_at_order += 1;
    }

    /// Goes on from an accepted step with the order of `best` and the growth that it allows; `scaled` has the last word on the
    /// factor.
    pub fn go_on(&mut self, best: (usize, f64), scaled: impl FnOnce(f64) -> f64) {
        let (mut order, growth) = best;
        let most = if self.accepted == 0 { FIRST_GROWTH } else { MOST_GROWTH };
        let mut growth = growth.min(most);
        if self.failures > 0 {
            growth = growth.min(1.0);
        }
        if growth > 1.0 && growth < LEAST_GROWTH {
            growth = 1.0;
            order = self.order;
        }
        if order != self.order {
            self.steps_at_order = 0;
        }
        self.order = order;
        self.step *= scaled(growth.max(LEAST));
        self.accepted += 1;
        self.failures = 0;
    }

    /// Goes on from a step in which the state stayed, as from a start.
    pub fn hold(&mut self) {
        *self = Self { accepted: self.accepted + 1, ..Self::starting(self.step * MOST_GROWTH) };
    }
}
