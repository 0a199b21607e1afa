//! Order and size of the steps of a multistep method.

use serde::{Deserialize, Serialize};

use super::clock::{Clock, fastest};

/// Growth of a step at most.
pub const MOST_GROWTH: f64 = 2.8;
/// Growth after the first step.
const FIRST_GROWTH: f64 = 1e4;
/// Growth below this factor is not worth what a new step size costs.
const LEAST_GROWTH: f64 = 1.1;
/// Steps shrink by no more than this factor after one that went well.
const LEAST: f64 = 0.5;
/// Growth by the clock at most, where that is not time itself: the size of steps that grow with the time is to change smoothly.
const MOST_BY_CLOCK: f64 = 1.5;

/// Stages are solved better by the first factor after an attempt whose error was too large, down to the second; by the third their
/// error grows back with each accepted step.
const BETTER: f64 = 0.25;
const BEST: f64 = 0.05;
const WORSE: f64 = 1.1;
/// Linear systems are solved better by the first factor after a step that what they leave has spoilt, down to the second; also by the
/// third it grows back.
const LESS: f64 = 0.01;
const LEAST_RESIDUAL: f64 = 1e-4;

/// A step whose error was too large is tried again with a part of it in this range, as usual for multistep codes: the estimate is not to
/// be trusted farther down, and a step that hardly shrinks fails again.
const SHRINKING: [f64; 2] = [0.2, 0.9];
/// Growth where there is no error is one over this: no number that overflows.
const NO_ERROR: f64 = 1e-6;
/// Rates below this have no reciprocals to speak of: a state at rest.
pub const LEAST_RATE: f64 = 1e-280;

/// Steps of the scale on an octave.
const SCALE: f64 = 16.0;
/// Part of a step of the scale by which a factor may be below one through rounding.
const ON_STEP: f64 = 1e-6;

/// Ratio of the next step size for which an error that is `error` times what is allowed, and falls by the power `power` of the step,
/// is just allowed.
pub fn growth_for(error: f64, power: f64) -> f64 {
    1.0 / (error.powf(1.0 / power) + NO_ERROR)
}

/// The factor by which a step shrinks that is tried again, from the one that its error asks for.
pub fn shrinking(growth: f64) -> f64 {
    growth.clamp(SHRINKING[0], SHRINKING[1])
}

/// The next factor below on a geometric scale. Estimates of errors are differences, whose rounding would go on to all
/// steps; so it goes on only where it tips the scale.
pub fn on_scale(factor: f64) -> f64 {
    ((SCALE * factor.log2() + ON_STEP).floor() / SCALE).exp2()
}

/// Order and size of the next step, and how the steps before went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    pub order: usize,
    pub last_order: usize,
    pub step: f64,
    /// Part of the size that the errors of a step would allow which the next one takes.
    pub share: f64,
    /// Part of the usual error to which the stages are solved.
    pub exactness: f64,
    /// Part of the usual residual to which linear systems are solved.
    pub residual: f64,
    /// Rates of the clocks of the next step, from its start, and of the last one, from its end.
    pub stretch: f64,
    pub last_stretch: f64,
    pub steps_at_order: usize,
    /// Accepted steps, and attempts thrown away since the last of them.
    pub accepted: u64,
    pub failures: u32,
}

/// What the errors of a step say of the next one: its order, its growth and the rate of its clock, both by that clock from the
/// start of the step on.
#[derive(Clone, Copy, Debug)]
pub struct Next {
    pub order: usize,
    pub growth: f64,
    pub stretch: f64,
}

impl Next {
    /// The one of the two whose growth is larger, this one if they are the same.
    pub fn or(self, other: Self) -> Self {
        if other.growth > self.growth { other } else { self }
    }
}

impl Pace {
    /// At a start, with a first step of size `step`.
    pub fn starting(step: f64) -> Self {
        Self {
            order: 1,
            last_order: 1,
            step,
            share: 1.0,
            exactness: 1.0,
            residual: 1.0,
            stretch: 0.0,
            last_stretch: 0.0,
            steps_at_order: 0,
            accepted: 0,
            failures: 0,
        }
    }

    /// The same with orders of at most `most`.
    pub fn of_order_at_most(self, most: usize) -> Self {
        Self { order: self.order.min(most), last_order: self.last_order.min(most), ..self }
    }

    /// The clock of the step from the first of `times`.
    pub fn clock(&self, times: &[f64]) -> Clock {
        Clock::new(times[0], self.stretch)
    }

    /// How long ago the oldest of `times` is that the step, or a change of its order, looks at.
    pub fn reach(&self, times: &[f64]) -> f64 {
        times[0] - times[(self.order + 1).min(times.len() - 1)]
    }

    /// Whether the clock runs at these times, and steps can be a part of what their errors allow.
    pub fn fits(&self, times: &[f64]) -> bool {
        (0.0..f64::INFINITY).contains(&self.stretch)
            && self.last_stretch.is_finite()
            && self.stretch * self.reach(times) < 1.0
            && self.share > 0.0
            && self.share <= 1.0
            && self.exactness > 0.0
            && self.exactness <= 1.0
            && self.residual > 0.0
            && self.residual <= 1.0
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

    /// After an attempt whose error was too large: it may be what the solves of the past stages have left, which a prediction
    /// multiplies and no shorter step makes smaller.
    pub fn solve_better(&mut self) {
        self.exactness = (BETTER * self.exactness).max(BEST);
    }

    /// After an attempt that what linear systems have left in stiff modes has spoilt. A prediction multiplies it, and each solve takes a
    /// factor of the residual only, of which it may leave the rest in modes that are less stiff, where it is more of an error.
    pub fn leave_less(&mut self) {
        self.residual = (LESS * self.residual).max(LEAST_RESIDUAL);
    }

    /// A step is accepted.
    pub fn accept(&mut self) {
        self.exactness = (WORSE * self.exactness).min(1.0);
        self.residual = (WORSE * self.residual).min(1.0);
        self.last_order = self.order;
        self.steps_at_order += 1;
    }

    /// Goes on from an accepted step, from the first of `times` on with past states at the others, to `next`; its growth becomes at
    /// most `most_growth`, and `scaled` has the last word on the factor.
    pub fn go_on(&mut self, next: Next, most_growth: f64, times: &[f64], scaled: impl FnOnce(f64) -> f64) {
        let run = next.stretch * self.step;
        let by_time = |growth: f64| {
            if run == 0.0 {
                return growth;
            }
            (1.0 + run) * (growth.min(MOST_BY_CLOCK) * run.ln_1p()).exp_m1() / run
        };
        let most = match (self.failures, self.accepted) {
            (0, 0) => FIRST_GROWTH,
            (0, _) => MOST_GROWTH,
            _ => 1.0,
        };
        let (mut order, mut growth) = (next.order, by_time(next.growth).min(most));
        if growth > 1.0 && growth < LEAST_GROWTH {
            (order, growth) = (self.order, 1.0);
        }
        if order != self.order {
            self.steps_at_order = 0;
        }
        self.order = order;
        let reach = self.reach(times) + self.step;
        self.last_stretch = self.stretch / (1.0 + self.stretch * self.step);
        self.stretch = (next.stretch / (1.0 + run)).min(fastest(reach));
        self.step *= scaled(growth.min(by_time(most_growth)).max(LEAST));
        self.accepted += 1;
        self.failures = 0;
    }

    /// Goes on from a step in which the state stayed, as from a start.
    pub fn hold(&mut self) {
        *self = Self { accepted: self.accepted + 1, ..Self::starting(self.step * MOST_GROWTH) };
    }
}
