//! The part that all one-step methods share: state, error norm, step size, integrals.

use std::fmt::Debug;

use flow_core::integrator::{Counters, ErrorNorm, INTEGRALS, Integrals, Problem, Rejection, Stepper};

use super::controller::Controller;

/// One step of a method with an estimate of its error.
pub trait Formula: Debug {
    /// Order of the solution.
    fn order(&self) -> usize;

    /// Order of the embedded solution.
    fn embedded_order(&self) -> usize;

    /// Takes a step of `size` from `y` into `next`, with the difference to the embedded solution in `error`.
    /// Algebraic systems are solved to `goal` in `norm`. False if that fails.
    #[allow(clippy::too_many_arguments)] // all of a step
    fn advance(
        &mut self,
        problem: &mut dyn Problem,
        norm: &ErrorNorm,
        y: &[f64],
        size: f64,
        goal: f64,
        next: &mut [f64],
        error: &mut [f64],
        counters: &mut Counters,
    ) -> bool;

    /// Tells that the last step was accepted; its projected end is where the next one starts.
    fn accepted(&mut self);

    /// The least growth of the step size that is worth its cost.
    fn worthwhile_growth(&self) -> f64 {
        1.0
    }
}

/// Growth of the last steps above which the integrals take the logarithm of the time for their clock.
const GROWING: f64 = 1.5;
/// Algebraic systems are solved to this part of the tolerance.
const ALGEBRAIC: f64 = 0.03;

/// An adaptive one-step method.
#[derive(Debug)]
pub struct OneStep {
    formula: Box<dyn Formula>,
    controller: Controller,
    integrals: Integrals,
    norm: ErrorNorm,
    tolerance: f64,
    time: f64,
    start: f64,
    step: f64,
    /// Size of the first step, and of the last ones, newest first.
    first: f64,
    sizes: [f64; 3],
    failed: bool,
    error_norm: f64,
    state: Vec<f64>,
    before: Vec<f64>,
    candidate: Vec<f64>,
    error: Vec<f64>,
}

impl OneStep {
    /// Starts at `y` and time 0 with local errors below `tolerance` in the relative norm.
    pub fn new(
        formula: Box<dyn Formula>,
        problem: &mut dyn Problem,
        y: &[f64],
        integral_rates: [f64; INTEGRALS],
        tolerance: f64,
        counters: &mut Counters,
    ) -> Self {
        let mut norm = ErrorNorm::new(problem);
        norm.rescale(problem, y);
        let mut rate = vec![0.0; y.len()];
        problem.rate(y, &mut rate);
        counters.right_hand_sides += 1;
        let step = 0.1 * tolerance.sqrt() / norm.norm(&rate).max(1e-280);
        Self {
            controller: Controller::new(formula.embedded_order()),
            formula,
            integrals: Integrals::new(0.0, [0.0; INTEGRALS], integral_rates),
            norm,
            tolerance,
            time: 0.0,
            start: 0.0,
            step,
            first: 0.0,
            sizes: [f64::INFINITY; 3],
            failed: false,
            error_norm: 0.0,
            state: y.to_vec(),
            before: y.to_vec(),
            candidate: y.to_vec(),
            error: rate,
        }
    }
}

impl Stepper for OneStep {
    fn time(&self) -> f64 {
        self.time
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn integrals(&self) -> [f64; INTEGRALS] {
        self.integrals.values()
    }

    fn step_size(&self) -> f64 {
        self.step
    }

    fn limit_step_size(&mut self, largest: f64) {
        self.step = self.step.min(largest);
    }

    fn order(&self) -> usize {
        self.formula.order()
    }

    fn attempt(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> Result<(), Rejection> {
        self.norm.rescale(problem, &self.state);
        let solved = self.formula.advance(
            problem,
            &self.norm,
            &self.state,
            self.step,
            ALGEBRAIC * self.tolerance,
            &mut self.candidate,
            &mut self.error,
            counters,
        );
        if !solved {
            self.failed = true;
            self.step *= 0.25;
            return Err(Rejection::Solver);
        }
        self.error_norm = self.norm.norm(&self.error) / self.tolerance;
        if !self.error_norm.is_finite() {
            self.refuse(Rejection::NotFinite, 0.5);
            return Err(Rejection::NotFinite);
        }
        if self.error_norm > 1.0 {
            self.failed = true;
            self.step *= self.controller.rejected(self.error_norm);
            return Err(Rejection::Error);
        }
        Ok(())
    }

    fn candidate(&mut self) -> &mut [f64] {
        &mut self.candidate
    }

    fn integrals_ahead(&self, rates: [f64; INTEGRALS]) -> Integrals {
        let grows = self.step > GROWING * self.sizes[2];
        let stretch = if grows { 1.0 / (self.time + self.first) } else { 0.0 };
        self.integrals.after(self.time + self.step, rates, stretch)
    }

    fn hold(&mut self, size: f64) {
        self.start = self.time;
        self.time += size;
        self.before.copy_from_slice(&self.state);
        self.candidate.copy_from_slice(&self.state);
        self.integrals.hold(self.time);
        self.step = 2.0 * size;
        self.failed = false;
    }

    fn refuse(&mut self, _: Rejection, factor: f64) {
        self.failed = true;
        self.step *= factor;
    }

    fn accept(&mut self, integrals: Integrals, _: f64) {
        if self.time == 0.0 {
            self.first = self.step;
        }
        self.sizes.rotate_right(1);
        self.sizes[0] = self.step;
        self.start = self.time;
        self.time += self.step;
        self.before.copy_from_slice(&self.state);
        self.state.copy_from_slice(&self.candidate);
        self.integrals = integrals;
        self.formula.accepted();
        let factor = self.controller.accepted(self.error_norm, self.failed);
        if !(1.0..self.formula.worthwhile_growth()).contains(&factor) {
            self.step *= factor;
        }
        self.failed = false;
    }

    /// Linear between the ends of the step: the measurements read states at the ends only.
    fn interpolate(&self, time: f64, y: &mut [f64]) -> [f64; INTEGRALS] {
        let part = (time - self.start) / (self.time - self.start);
        for ((y, a), b) in y.iter_mut().zip(&self.before).zip(&self.state) {
            *y = a + part * (b - a);
        }
        self.integrals.at(time)
    }
}
