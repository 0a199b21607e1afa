//! A problem whose calls are clocked.

use std::ops::Range;
use std::time::Instant;

use super::{Activity, Stopwatch};
use crate::integrator::{Finish, INTEGRALS, LinearPart, Problem};

/// A problem under a stopwatch. What the integrator does between two calls is Krylov work while a linear solve goes on, and
/// step control else.
#[derive(Debug)]
pub struct Clocked<'a, P> {
    problem: &'a mut P,
    watch: &'a mut Stopwatch,
}

impl<'a, P: Problem> Clocked<'a, P> {
    /// `problem` under `watch`.
    pub fn new(problem: &'a mut P, watch: &'a mut Stopwatch) -> Self {
        Self { problem, watch }
    }

    fn during<T>(&mut self, activity: Activity, then: Activity, call: impl FnOnce(&mut P) -> T) -> T {
        if self.watch.lacks(activity) {
            self.watch.lap = Some((activity, Instant::now()));
            self.watch.count(activity);
            let result = call(self.problem);
            self.watch.end_step();
            return result;
        }
        self.watch.turn_to(activity);
        self.watch.count(activity);
        let result = call(self.problem);
        self.watch.turn_to(then);
        result
    }
}

impl<P: Problem> Problem for Clocked<'_, P> {
    fn size(&self) -> usize {
        self.problem.size()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        self.problem.blocks()
    }

    fn block_floor(&self, block: usize, y: &[f64]) -> f64 {
        self.problem.block_floor(block, y)
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.during(Activity::RightHandSide, Activity::StepControl, |problem| problem.rate(y, rate));
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.during(Activity::Linearisation, Activity::StepControl, |problem| problem.linearise(y, rate));
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.during(Activity::JacobianProduct, Activity::Krylov, |problem| problem.jacobian_product(v, out));
        self.watch.count(Activity::Krylov); // each product is one iteration
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.during(Activity::Factorisation, Activity::StepControl, |problem| problem.factorise(gamma))
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.during(Activity::Solve, Activity::Krylov, |problem| problem.precondition(r));
    }

    fn weigh(&self, r: &mut [f64]) {
        self.problem.weigh(r);
    }

    fn unweigh(&self, r: &mut [f64]) {
        self.problem.unweigh(r);
    }

    fn settle(&mut self, gamma: f64, r: &mut [f64]) -> bool {
        self.problem.settle(gamma, r)
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.watch.turn_to(Activity::StepControl);
        self.problem.krylov_feedback(iterations)
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        self.during(Activity::Check, Activity::StepControl, |problem| problem.finish(time, y))
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        self.problem.energy_slope(direction)
    }

    fn rests_with_its_energy(&self) -> bool {
        self.problem.rests_with_its_energy()
    }

    fn forgets(&self) -> bool {
        self.problem.forgets()
    }

    fn undamped_frequency(&self) -> f64 {
        self.problem.undamped_frequency()
    }

    fn energy_rounding(&self, y: &[f64]) -> f64 {
        self.problem.energy_rounding(y)
    }

    fn is_gradient_exact(&mut self, y: &[f64]) -> Option<bool> {
        self.problem.is_gradient_exact(y)
    }

    fn finished_rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.problem.finished_rate(y, rate);
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        self.during(Activity::Linearisation, Activity::StepControl, |problem| problem.linear_part(y, part))
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.problem.accepted(time, integrals);
    }
}
