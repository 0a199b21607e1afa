//! Exponential Adams method of variable order and step size, predict–evaluate–correct–evaluate.
//!
//! With J ≈ Λ + rest, Λ diagonal in its eigenbasis, dy/dt = Λy + N(y). The solution of this with a polynomial in place of N is
//! exact in Λ:  y(t + h) = e^{hΛ}y + h Σᵢ mᵢ(hΛ) cᵢ,  P(θ) = Σ cᵢθⁱ. The predictor's polynomial, in stretched time, goes through the
//! last k values of N, the corrector's through these and the value at the prediction; what they differ by without the oldest value is
//! the error. There are no linear systems: it serves while N is not stiff. See `THEORY.md`, eqs. (I10) to (I12); Hochbruck & Ostermann,
//! BIT 51 (2011) 889; order and step size as Shampine & Gordon, Computer Solution of Ordinary Differential Equations (1975).

mod blocked;
mod control;
mod formula;
mod memory;
mod moments;
mod orders;
mod polynomials;
mod start;
mod substitution;
mod sums;

use super::error_norm::ErrorNorm;
use super::history::{History, MOST_POINTS};
use super::integrals::Integrals;
use super::linear_part::LinearPart;
use super::pace::Pace;
use super::{Counters, INTEGRALS, Problem, Rejection, Stepper};
use crate::geometry::vectors::add_scaled_product;
use blocked::Blocked;
use control::Stiffness;
pub use memory::ExponentialMemory;
use moments::Moments;
use orders::{FOR_CLOCKS, MOST_MOMENTS};
pub(super) use start::start;
use substitution::{StepClock, Substitution};

/// Changes that are computed at once: the correction, and the differences that tell the error.
const MOST_CHANGES: usize = 5;
/// Accepted steps after which Λ is taken anew.
const OLDEST_PART: usize = 20;

/// Exponential Adams method of variable order and step: exact in the linear part Λ of f, with a polynomial through the last values of the
/// rest, f − Λy. See `THEORY.md`, eqs. (I10)–(I12). [`Multistep`](super::Multistep) starts it.
#[derive(Clone, Debug)]
pub struct Exponential {
    states: History,
    /// f at these states.
    rates: History,
    integrals: Integrals,
    norm: ErrorNorm,
    tolerance: f64,
    part: LinearPart,
    /// Storage for the next one.
    next_part: LinearPart,
    part_age: usize,
    moments: Moments,
    substitution: Substitution,
    /// u of the past states; no number where the clock does not run.
    nodes: [f64; MOST_MOMENTS],
    /// N = f − Λy at the states in the eigenbasis, newest first; the newest states there.
    rests: Vec<Blocked>,
    bases: [Blocked; 2],
    pace: Pace,
    stiffness: Stiffness,
    /// Rate of the clock that would have served the last attempt best.
    best_stretch: f64,
    /// What the last n values of N change instead of n − 1, where it is known.
    differences: [Option<f64>; MOST_POINTS + 1],
    predicted: Blocked,
    candidate: Vec<f64>,
    /// N at the prediction.
    predicted_rest: Blocked,
    /// f and N at the candidate, and the candidate in the eigenbasis.
    candidate_rate: Vec<f64>,
    candidate_rest: Blocked,
    candidate_base: Blocked,
    /// What the corrector changes, and what it would with a value less of each number that is watched.
    changes: [Blocked; MOST_CHANGES],
    scratch: Vec<f64>,
}

impl Exponential {
    /// u of the last `points` states by `clock`.
    fn nodes_by(&self, points: usize, clock: StepClock) -> [f64; MOST_MOMENTS] {
        let times = self.states.times();
        clock.nodes(&times[..points], times[0], self.pace.step)
    }

    /// Takes Λ anew from the last state if it has aged.
    fn renew(&mut self, problem: &mut dyn Problem, counters: &mut Counters) {
        if self.part_age < OLDEST_PART && !(self.part_age > 0 && self.stiffness.is_part_outdated()) {
            return;
        }
        counters.right_hand_sides += 1; // the linearisation takes as much
        counters.factorisations += 1;
        std::mem::swap(&mut self.part, &mut self.next_part);
        if !problem.linear_part(self.states.state(0), &mut self.part) {
            std::mem::swap(&mut self.part, &mut self.next_part); // that of another state serves as well
        }
        self.moments.forget();
        self.decompose();
        self.part_age = 0;
    }

    /// The states and the rates in the eigenbasis.
    fn decompose(&mut self) {
        for back in 0..self.states.len() {
            decompose(
                &self.part,
                self.states.state(back),
                self.rates.state(back),
                &mut self.rests[back],
                &mut self.scratch,
            );
            if back < self.bases.len() {
                self.bases[back].copy_from_slice(&self.scratch);
            }
        }
    }
}

/// `rest` = N of the state `y` with the rate `f` in the eigenbasis, and `base` = y there.
fn decompose(part: &LinearPart, y: &[f64], f: &[f64], rest: &mut [f64], base: &mut [f64]) {
    base.copy_from_slice(y);
    part.to_eigenbasis(base);
    rest.copy_from_slice(f);
    part.to_eigenbasis(rest);
    add_scaled_product(rest, -1.0, part.rates(), base);
}

impl Stepper for Exponential {
    fn time(&self) -> f64 {
        self.states.times()[0]
    }

    fn state(&self) -> &[f64] {
        self.states.state(0)
    }

    fn integrals(&self) -> [f64; INTEGRALS] {
        self.integrals.values()
    }

    fn step_size(&self) -> f64 {
        self.pace.step
    }

    fn limit_step_size(&mut self, largest: f64) {
        self.pace.step = self.pace.step.min(largest);
    }

    /// That of the corrector.
    #[allow(clippy::misnamed_getters)] // the order of the last step; `order` is that of the next
    fn order(&self) -> usize {
        self.pace.last_order + 1
    }

    fn attempt(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> Result<(), Rejection> {
        self.renew(problem, counters);
        // One more than the corrector's order: the balance is held to less than the tolerance of the state.
        self.integrals.serve_order(self.pace.order + 2);
        self.norm.rescale(problem, self.states.state(0));
        let (clock, order) = (StepClock::new(self.pace.stretch * self.pace.step), self.pace.order);
        self.substitution.set(clock, order + FOR_CLOCKS);
        self.nodes = self.nodes_by(self.states.len(), clock);
        self.moments.set(self.pace.step, self.part.rates(), self.substitution.terms(order + 3));
        self.predict();
        problem.rate(&self.predicted, &mut self.candidate);
        counters.right_hand_sides += 1;
        let Self { part, predicted, candidate, predicted_rest, scratch, .. } = self;
        decompose(part, predicted, candidate, predicted_rest, scratch);
        self.correct();
        self.judge()
    }

    fn confirm(&mut self, problem: &mut dyn Problem) -> Result<(), Rejection> {
        problem.finished_rate(&self.candidate, &mut self.candidate_rate);
        let Self { part, candidate, candidate_rate, candidate_rest, candidate_base, .. } = self;
        decompose(part, candidate, candidate_rate, candidate_rest, candidate_base);
        self.watch_contraction()
    }

    fn candidate(&mut self) -> &mut [f64] {
        &mut self.candidate
    }

    fn integrals_ahead(&self, rates: [f64; INTEGRALS]) -> Integrals {
        self.integrals.after(self.time() + self.pace.step, rates, self.pace.stretch)
    }

    fn hold(&mut self, size: f64) {
        self.pace.step = size;
        let time = self.time() + size;
        self.candidate.copy_from_slice(self.states.state(0));
        self.states.push(time, &self.candidate);
        self.scratch.fill(0.0);
        self.rates.push(time, &self.scratch);
        self.decompose();
        self.integrals.hold(time);
        self.pace.hold();
    }

    fn refuse(&mut self, _: Rejection, factor: f64) {
        self.fail(factor);
    }

    fn accept(&mut self, integrals: Integrals, most_growth: f64) {
        let time = self.time() + self.pace.step;
        self.pace.accept();
        self.rests.rotate_right(1);
        self.bases.rotate_right(1);
        std::mem::swap(&mut self.rests[0], &mut self.candidate_rest);
        std::mem::swap(&mut self.bases[0], &mut self.candidate_base);
        self.rates.push(time, &self.candidate_rate);
        self.plan(most_growth);
        self.states.push(time, &self.candidate);
        self.integrals = integrals;
        self.part_age += 1;
    }

    /// The formula of the step itself, with the values of N at its end and before.
    fn interpolate(&self, time: f64, y: &mut [f64]) -> [f64; INTEGRALS] {
        let times = self.states.times();
        let points = (self.pace.last_order + 1).min(self.states.len());
        // There is no polynomial yet, or nothing to be integrated.
        if points < 2 || time <= times[1] {
            y.copy_from_slice(self.states.state(usize::from(points > 1)));
            return self.integrals.at(time);
        }
        let size = time - times[1];
        let stretch = self.pace.last_stretch / (1.0 - self.pace.last_stretch * (times[0] - times[1]));
        let substitution =
            Substitution::new(StepClock::new(stretch * size), self.pace.last_order + FOR_CLOCKS);
        let nodes = substitution.clock().nodes(&times[..points], times[1], size);
        let basis = substitution.lagrange_basis(&nodes[..points]);
        let terms = substitution.terms(points);
        let (mut moments, mut value) = (Moments::new(y.len()), Blocked::new(y.len()));
        moments.set(size, self.part.rates(), terms);
        let basis = (&basis[..points], terms);
        sums::extrapolate(size, basis, moments.blocks(), (&self.bases[1], &self.rests), &mut value);
        y.copy_from_slice(&value);
        self.part.from_eigenbasis(y);
        self.integrals.at(time)
    }
}
