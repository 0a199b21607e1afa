//! Newton–Krylov iteration for an implicit stage y = a + γ f(y). See `THEORY.md`, eq. (I2).

use serde::{Deserialize, Serialize};

use super::error_norm::ErrorNorm;
use super::gmres::{Gmres, Target};
use super::{Counters, Problem, Rejection};
use crate::geometry::vectors::add_scaled;

const MOST_ITERATIONS: usize = 4;
const MOST_KRYLOV: usize = 60;
/// Linear residuals are reduced to this part of the goal: their square enters the dissipation.
const KRYLOV_SHARE: f64 = 0.8;
/// Each linear solve reduces its residual at least by this factor, so that Newton errors fade with the flow.
const KRYLOV_REDUCTION: f64 = 0.1;
/// γ may change by this factor before the preconditioner is factorised again, and by that one only if one was seen to age badly.
const GAMMA_DRIFT: f64 = 1.7;
const GAMMA_DRIFT_OF_BRITTLE: f64 = 1.05;
/// Iterations of a solve beyond twice those of the first one with the same factorisation which say that it ages badly.
const BRITTLE: usize = 6;
/// Size of the second correction over the first, before it is known: the linearisation is that of the guess, so
/// Newton's method converges quadratically.
const FIRST_CONTRACTION: f64 = 0.02;
/// Part of an estimated contraction that the next one keeps, as usual for BDF codes: one small correction may be luck.
const REMEMBERED: f64 = 0.3;
/// Corrections that grow by this factor diverge, as usual for BDF codes.
const DIVERGING: f64 = 2.0;
/// Accepted steps after which the preconditioner is renewed in any case.
const OLDEST_FACTORISATION: usize = 30;
/// Krylov iterations that an ageing preconditioner may take more than it did at first.
const MORE_ITERATIONS: usize = 1;

/// How an iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NewtonOutcome {
    /// The stage is solved.
    Converged,
    /// It is not; a smaller step is needed.
    Failed,
    /// It is not, since a value on the way was infinite or no number; as above.
    NotFinite,
}

impl NewtonOutcome {
    /// Why a step with this outcome, which is not convergence, is rejected.
    pub(super) fn rejection(self) -> Rejection {
        if self == Self::NotFinite { Rejection::NotFinite } else { Rejection::Solver }
    }
}

/// How exactly stages are solved.
#[derive(Clone, Copy, Debug)]
pub struct Exactness {
    /// Error, in the norm, to which y is wanted.
    pub goal: f64,
    /// Part of the usual residual that linear systems are to leave.
    pub residual: f64,
}

/// An implicit stage y = `constant` + `gamma` f(y).
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The norm of errors.
    pub norm: &'a ErrorNorm,
    /// γ.
    pub gamma: f64,
    /// What does not depend on y.
    pub constant: &'a [f64],
    /// How exactly it is solved.
    pub exactness: Exactness,
}

impl Stage<'_> {
    /// Turns the rate f(y) in `rate` into the residual a + γf(y) − y.
    pub(super) fn residual(&self, y: &[f64], rate: &mut [f64]) {
        for ((r, y), constant) in rate.iter_mut().zip(y).zip(self.constant) {
            *r = constant + self.gamma * *r - y;
        }
    }
}

/// How the residual of a linear solve is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Residual {
    /// With the weights of the problem.
    Weighted,
    /// All coefficients alike.
    Plain,
}

/// What a stage has taken so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Effort {
    /// Linear solves.
    pub solves: usize,
    /// Krylov iterations in them.
    pub iterations: usize,
}

/// Newton's method for a [`Stage`], each correction by [`Gmres`]; remembers the age of the factorisation. See `THEORY.md`, eq. (I2).
#[derive(Clone, Debug)]
pub struct NewtonKrylov {
    gmres: Gmres,
    /// The rate at an iterate, then its residual, then its correction.
    correction: Vec<f64>,
    factorisation: Factorisation,
    effort: Effort,
}

/// How old the factorisation is, and how well it serves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Factorisation {
    /// γ of the factorisation; none if there is none that may serve.
    pub gamma: Option<f64>,
    age: usize,
    /// Krylov iterations of the first solve with it, and of the last.
    iterations: [usize; 2],
    /// Whether one was seen to age badly.
    brittle: bool,
}

impl NewtonKrylov {
    /// For states of `size` entries.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self {
            gmres: Gmres::new(size, MOST_KRYLOV),
            correction: vec![0.0; size],
            factorisation: Factorisation::default(),
            effort: Effort::default(),
        }
    }

    /// What the last stage has taken, its corrections included.
    pub(super) fn effort(&self) -> Effort {
        self.effort
    }

    /// Age of the factorisation.
    #[must_use]
    pub fn factorisation(&self) -> Factorisation {
        self.factorisation
    }

    /// Goes on with a factorisation of the age `factorisation`.
    pub fn set_factorisation(&mut self, factorisation: Factorisation) {
        self.factorisation = factorisation;
    }

    /// Solves `stage` from `guess` into `y`.
    pub fn solve(
        &mut self,
        problem: &mut dyn Problem,
        stage: &Stage<'_>,
        guess: &[f64],
        y: &mut [f64],
        counters: &mut Counters,
    ) -> NewtonOutcome {
        self.effort = Effort::default();
        loop {
            problem.linearise(guess, &mut self.correction);
            counters.right_hand_sides += 1;
            let serves = self.factorisation_serves(stage.gamma);
            y.copy_from_slice(guess);
            if !serves && !self.factorise(problem, stage.gamma, counters) {
                return failed(stage.norm.norm(&self.correction));
            }
            let outcome = self.iterate(problem, stage, y, counters);
            if outcome == NewtonOutcome::Converged {
                self.factorisation.age += 1;
            }
            if outcome == NewtonOutcome::Converged || !serves {
                return outcome;
            }
            self.factorisation.gamma = None;
        }
    }

    fn factorisation_serves(&self, gamma: f64) -> bool {
        let drift = if self.factorisation.brittle { GAMMA_DRIFT_OF_BRITTLE } else { GAMMA_DRIFT };
        let near = |old: f64| gamma < drift * old && old < drift * gamma;
        let [first, last] = self.factorisation.iterations;
        let good = self.factorisation.age < OLDEST_FACTORISATION && last <= first + MORE_ITERATIONS;
        self.factorisation.gamma.is_some_and(near) && good
    }

    fn factorise(&mut self, problem: &mut dyn Problem, gamma: f64, counters: &mut Counters) -> bool {
        counters.factorisations += 1;
        self.factorisation.age = 0;
        self.factorisation.iterations = [0; 2];
        self.factorisation.gamma = problem.factorise(gamma).then_some(gamma);
        self.factorisation.gamma.is_some()
    }

    /// Corrects `y`, at which the rate is known, until the next correction would be below the goal.
    fn iterate(
        &mut self,
        problem: &mut dyn Problem,
        stage: &Stage<'_>,
        y: &mut [f64],
        counters: &mut Counters,
    ) -> NewtonOutcome {
        let (mut contraction, mut previous) = (FIRST_CONTRACTION, f64::INFINITY);
        for iteration in 0..MOST_ITERATIONS {
            if iteration > 0 {
                problem.rate(y, &mut self.correction);
                counters.right_hand_sides += 1;
            }
            let size = match self.correct_by_rate(problem, stage, Residual::Weighted, y, counters) {
                Ok(size) => size,
                Err(outcome) => return outcome,
            };
            if iteration > 0 {
                contraction = (REMEMBERED * contraction).max(size / previous);
            }
            if size * contraction.min(1.0) <= stage.exactness.goal {
                return NewtonOutcome::Converged;
            }
            if iteration > 0 && size > DIVERGING * previous {
                return NewtonOutcome::Failed;
            }
            previous = size;
        }
        NewtonOutcome::Failed
    }

    /// One Newton correction of `y`, with the linear residual small in every coefficient; its size, or none if the
    /// linear solve fails.
    pub fn correct(
        &mut self,
        problem: &mut dyn Problem,
        stage: &Stage<'_>,
        y: &mut [f64],
        counters: &mut Counters,
    ) -> Option<f64> {
        // At the state itself: the linearisation of a guess far away converges slowly, or not at all, in stiff modes.
        problem.linearise(y, &mut self.correction);
        counters.right_hand_sides += 1;
        self.correct_by_rate(problem, stage, Residual::Plain, y, counters).ok()
    }

    /// As [`NewtonKrylov::correct`], with the rate at `y` known and the `residual` small in its norm. What a weighted one takes
    /// tells how the factorisation ages.
    fn correct_by_rate(
        &mut self,
        problem: &mut dyn Problem,
        stage: &Stage<'_>,
        residual: Residual,
        y: &mut [f64],
        counters: &mut Counters,
    ) -> Result<f64, NewtonOutcome> {
        counters.newton_iterations += 1;
        stage.residual(y, &mut self.correction);
        let weighted = residual == Residual::Weighted;
        let (norm, goal) = (stage.norm, KRYLOV_SHARE * stage.exactness.goal);
        let (reduction, wanted) = (KRYLOV_REDUCTION, KRYLOV_REDUCTION * stage.exactness.residual);
        let target = Target { norm, goal, reduction, wanted, weighted };
        let solved = self.gmres.solve(problem, stage.gamma, target, &mut self.correction, counters);
        self.effort.solves += 1;
        self.effort.iterations += solved.iterations;
        if weighted {
            self.factorisation.iterations[1] = solved.iterations;
            if self.factorisation.age == 0 {
                self.factorisation.iterations[0] = solved.iterations;
            }
            let [first, last] = self.factorisation.iterations;
            self.factorisation.brittle |= last > 2 * first + BRITTLE;
        }
        if problem.krylov_feedback(solved.iterations) {
            self.factorisation.gamma = None;
        }
        let size = norm.norm(&self.correction);
        if !size.is_finite() || !solved.converged {
            return Err(failed(size + solved.residual));
        }
        add_scaled(y, 1.0, &self.correction);
        Ok(size)
    }
}

/// The outcome of a solve that failed, where `size` measures what it met.
#[cold]
fn failed(size: f64) -> NewtonOutcome {
    if size.is_finite() { NewtonOutcome::Failed } else { NewtonOutcome::NotFinite }
}
