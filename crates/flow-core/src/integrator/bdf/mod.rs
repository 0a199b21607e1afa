//! Backward differentiation formulas of order 1 to 5 with variable steps and fixed leading coefficient.
//!
//! The predictor is the polynomial through the last k + 1 states; the corrector agrees with it at
//! t − h … t − kh, which gives y = ỹ + (h/α)(f(y) − ỹ′) with α = 1 + ½ + … + 1/k; all in stretched time, of which the clock is chosen
//! anew for each step. See `THEORY.md`, eqs. (I4), (I5);
//! Brenan, Campbell & Petzold, Numerical Solution of Initial-Value Problems in DAEs (1996), chapter 5.

mod control;
mod formula;

use super::clock::Clock;
use super::error_norm::{ErrorNorm, check_start};
use super::history::{History, MOST_POINTS, lagrange};
use super::integrals::Integrals;
use super::memory::Memory;
use super::newton::{Exactness, Factorisation, NewtonKrylov, NewtonOutcome, Stage};
use super::pace::{Pace, shrinking};
use super::{Counters, INTEGRALS, Problem, Rejection, Stepper};
use crate::geometry::vectors::add_scaled;
use control::{BIAS_OF_FAILED, first_step, local_tolerance};

/// Highest order of the formulas that are stable enough.
pub(super) const HIGHEST_ORDER: usize = 5;
/// Newton's method is solved to this part of the local tolerance: the square of its error, weighted by the
/// stiffness, enters the dissipation and with it the energy balance.
const NEWTON_SHARE: f64 = 0.4;
/// … and to this part of that where the flow does not forget, or of the same for the largest local tolerance below: what solves leave on
/// short waves adds up from step to step then, and must stay below what nodes may leave unresolved.
const UNFORGOTTEN: f64 = 0.03;
const LARGEST_UNFORGOTTEN: f64 = 3e-4;

/// A step whose stage was not solved is tried again with this part of it, as usual for BDF codes.
const NEWTON_CUT: f64 = 0.25;

/// Backward differentiation formulas of order 1 to 5 with variable steps, and the last states. A step solves
/// y = ỹ + γ(f(y) − ỹ′) by Newton's method, ỹ the polynomial through the last states; order and step follow the error. See
/// `THEORY.md`, eqs. (I4) and (I5). [`Problem`] has an example.
#[derive(Clone, Debug)]
pub struct Bdf {
    history: History,
    integrals: Integrals,
    norm: ErrorNorm,
    newton: NewtonKrylov,
    tolerance: f64,
    /// Error to which stages are solved, as far as they need not be solved better.
    goal: f64,
    pace: Pace,
    predicted: Vec<f64>,
    constant: Vec<f64>,
    candidate: Vec<f64>,
    difference: Vec<f64>,
    /// What [`Problem::undamped_frequency`] says of the last step.
    undamped: f64,
}

impl Bdf {
    /// Starts at `y` and time 0 with local errors below `tolerance` in the relative norm.
    ///
    /// # Panics
    /// If `y` has not the size of the problem, or `tolerance` is not positive and finite.
    pub fn new(
        problem: &mut dyn Problem,
        y: &[f64],
        integral_rates: [f64; INTEGRALS],
        tolerance: f64,
        counters: &mut Counters,
    ) -> Self {
        let integrals = Integrals::new(0.0, [0.0; INTEGRALS], integral_rates);
        Self::starting(problem, y, integrals, tolerance, counters)
    }

    /// Starts at `y` and the time of `integrals`, which go on from their values.
    ///
    /// # Panics
    /// As [`Bdf::new`].
    pub fn starting(
        problem: &mut dyn Problem,
        y: &[f64],
        integrals: Integrals,
        tolerance: f64,
        counters: &mut Counters,
    ) -> Self {
        check_start(problem, y, tolerance);
        let size = y.len();
        let mut norm = ErrorNorm::new(problem);
        norm.rescale(problem, y);
        let mut rate = vec![0.0; size];
        problem.rate(y, &mut rate);
        counters.right_hand_sides += 1;
        let step = first_step(tolerance, norm.norm(&rate));
        let mut history = History::new(size);
        let before: Vec<f64> = y.iter().zip(&rate).map(|(y, rate)| y - step * rate).collect();
        let time = integrals.time();
        history.push(time - step, &before);
        history.push(time, y);
        let memory = Memory {
            points: history.points(),
            integrals,
            factorisation: Factorisation::default(),
            exponential: None,
            pace: Pace::starting(step),
        };
        Self::resume(problem, memory, tolerance)
    }

    /// What it takes to go on from here.
    #[must_use]
    pub fn memory(&self) -> Memory {
        Memory {
            points: self.history.points(),
            integrals: self.integrals.clone(),
            factorisation: self.newton.factorisation(),
            exponential: None,
            pace: self.pace,
        }
    }

    /// Goes on from `memory`, to the same local errors as before if `tolerance` is the same.
    ///
    /// The factorisation that the memory speaks of must be in `problem`.
    #[must_use]
    pub fn resume(problem: &dyn Problem, mut memory: Memory, tolerance: f64) -> Self {
        memory.integrals.serve_order(HIGHEST_ORDER);
        let size = problem.size();
        let tolerance = local_tolerance(tolerance);
        let share =
            if problem.forgets() { 1.0 } else { UNFORGOTTEN * (LARGEST_UNFORGOTTEN / tolerance).min(1.0) };
        let mut newton = NewtonKrylov::new(size);
        newton.set_factorisation(memory.factorisation);
        Self {
            history: History::of(size, &memory.points),
            integrals: memory.integrals,
            norm: ErrorNorm::new(problem),
            newton,
            tolerance,
            goal: share * NEWTON_SHARE * tolerance,
            pace: memory.pace,
            predicted: vec![0.0; size],
            constant: vec![0.0; size],
            candidate: vec![0.0; size],
            difference: vec![0.0; size],
            undamped: 0.0,
        }
    }

    fn exactness(&self) -> Exactness {
        Exactness { goal: self.pace.exactness * self.goal, residual: self.pace.residual }
    }
}

impl Stepper for Bdf {
    fn time(&self) -> f64 {
        self.history.times()[0]
    }

    fn state(&self) -> &[f64] {
        self.history.state(0)
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

    #[allow(clippy::misnamed_getters)] // the order of the last step; `order` is that of the next
    fn order(&self) -> usize {
        self.pace.last_order
    }

    fn attempt(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> Result<(), Rejection> {
        self.norm.rescale(problem, self.history.state(0));
        let weights = self.predictor(self.pace.order, self.clock());
        let points = self.pace.order + 1;
        let gamma = self.gamma();
        self.history.combine(&weights.value, points, &mut self.predicted);
        let shifted: [f64; MOST_POINTS] =
            std::array::from_fn(|i| weights.value[i] - gamma * weights.derivative[i]);
        self.history.combine(&shifted, points, &mut self.constant);
        let stage = Stage { norm: &self.norm, gamma, constant: &self.constant, exactness: self.exactness() };
        let outcome = self.newton.solve(problem, &stage, &self.predicted, &mut self.candidate, counters);
        if outcome != NewtonOutcome::Converged {
            self.pace.fail(NEWTON_CUT);
            return Err(outcome.rejection());
        }
        for ((difference, y), predicted) in
            self.difference.iter_mut().zip(&self.candidate).zip(&self.predicted)
        {
            *difference = y - predicted;
        }
        self.undamped = problem.undamped_frequency();
        let error = self.error_factor() * self.norm.norm(&self.difference);
        if error > self.tolerance {
            let growth = self.growth(error, self.pace.order, BIAS_OF_FAILED);
            self.pace.solve_better();
            self.pace.fail(shrinking(growth));
            return Err(Rejection::Error);
        }
        Ok(())
    }

    fn settle(&mut self, problem: &mut dyn Problem) -> bool {
        let gamma = self.gamma();
        problem.finished_rate(&self.candidate, &mut self.difference);
        let stage = Stage { norm: &self.norm, gamma, constant: &self.constant, exactness: self.exactness() };
        stage.residual(&self.candidate, &mut self.difference);
        let settles = problem.settle(gamma, &mut self.difference);
        if settles {
            add_scaled(&mut self.candidate, 1.0, &self.difference);
        }
        settles
    }

    fn unsettle(&mut self) {
        add_scaled(&mut self.candidate, -1.0, &self.difference);
    }

    fn polish(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> bool {
        let gamma = self.gamma();
        let stage = Stage { norm: &self.norm, gamma, constant: &self.constant, exactness: self.exactness() };
        self.newton.correct(problem, &stage, &mut self.candidate, counters).is_some()
    }

    /// −⟨∇𝓕, ẏ⟩ with the derivative ẏ of the polynomial that is the step. An error e that the solve leaves in stiff modes, where
    /// ∇𝓕 is small, adds ⟨Hess·e, 𝓚 Hess·e⟩ to the dissipation of the state, and would die before the next step.
    fn dissipation(&mut self, problem: &mut dyn Problem, dissipation: f64) -> f64 {
        let gamma = self.gamma();
        for ((difference, y), constant) in self.difference.iter_mut().zip(&self.candidate).zip(&self.constant)
        {
            *difference = (y - constant) / gamma;
        }
        let slope = problem.energy_slope(&self.difference);
        slope.map(|slope| -slope).filter(|lost| *lost > 0.0).unwrap_or(dissipation)
    }

    fn integrals_ahead(&self, rates: [f64; INTEGRALS]) -> Integrals {
        self.integrals.after(self.candidate_time(), rates, self.pace.stretch)
    }

    fn hold(&mut self, size: f64) {
        self.pace.step = size;
        let time = self.candidate_time();
        self.candidate.copy_from_slice(self.history.state(0));
        self.history.push(time, &self.candidate);
        self.integrals.hold(time);
        self.pace.hold();
    }

    fn candidate(&mut self) -> &mut [f64] {
        &mut self.candidate
    }

    fn leave_less(&mut self) {
        self.pace.leave_less();
    }

    fn refuse(&mut self, cause: Rejection, factor: f64) {
        if cause == Rejection::EnergyRise {
            self.pace.leave_less();
        }
        self.pace.fail(factor);
    }

    fn accept(&mut self, integrals: Integrals, most_growth: f64) {
        let time = self.candidate_time();
        self.pace.accept();
        self.plan(most_growth);
        self.history.push(time, &self.candidate);
        self.integrals = integrals;
    }

    fn interpolate(&self, time: f64, y: &mut [f64]) -> [f64; INTEGRALS] {
        let points = (self.pace.last_order + 1).min(self.history.len());
        let clock = Clock::new(self.history.times()[0], self.pace.last_stretch);
        let weights = lagrange(clock.at(time), &clock.all(self.history.times())[..points]);
        self.history.combine(&weights.value, points, y);
        self.integrals.at(time)
    }
}
