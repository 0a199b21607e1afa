//! The linear solver of a membrane, and the choice between several of them.

use serde::{Deserialize, Serialize};

use crate::flow::{GradientFlow, LinearSolver, Preconditioner};

/// Krylov iterations per solve, averaged, above which the automatic choice turns to the banded solver.
const FOURIER_SERVES: f64 = 3.0;
/// … and the banded one to a band of all modes, or of the normal velocity, which cost more: fronts, whose high modes are small, need fewer,
/// and so do short steps.
const BAND_SERVES: f64 = 20.0;
/// Weight of the last solve in that average.
const WEIGHT: f64 = 0.1;

/// What the choice has come to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    kind: LinearSolver,
    mean_iterations: f64,
}

/// A preconditioner that is built once it is needed: a run that solves no linear systems has none.
#[derive(Debug)]
pub struct Solver {
    choice: Choice,
    built: Option<Preconditioner>,
}

impl Solver {
    /// One of `kind`; the automatic choice starts with the symbol.
    pub fn new(kind: LinearSolver) -> Self {
        Self { choice: Choice { kind, mean_iterations: 0.0 }, built: None }
    }

    /// What has been chosen so far.
    pub fn choice(&self) -> Choice {
        self.choice
    }

    /// Goes on from `choice`.
    pub fn choose(&mut self, choice: Choice) {
        *self = Self { choice, built: None };
    }

    /// Learns how many Krylov iterations a solve for `flow` took; true if the solver is another one from now on.
    pub fn learn(&mut self, iterations: usize, flow: &GradientFlow) -> bool {
        let Choice { kind, mean_iterations: mean } = &mut self.choice;
        *mean += WEIGHT * (iterations as f64 - *mean);
        let serves = if *kind == LinearSolver::Auto { FOURIER_SERVES } else { BAND_SERVES };
        if *mean <= serves {
            return false;
        }
        let Some(next) = Preconditioner::after(*kind, flow) else { return false };
        (*kind, *mean) = (next, 0.0); // what the one before took says nothing of this one
        self.built = None;
        true
    }

    /// Factorises at the linearisation of `flow`; false if that fails.
    pub fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> bool {
        let kind = self.choice.kind;
        let built = self.built.get_or_insert_with(|| Preconditioner::new(kind, flow));
        built.factorise(flow, gamma).is_ok()
    }

    /// Solves with the last factorisation.
    pub fn apply(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        if let Some(built) = &mut self.built {
            built.apply(flow, r);
        }
    }

    /// Weighs a residual by the last factorisation.
    pub fn weigh(&self, r: &mut [f64]) {
        if let Some(built) = &self.built {
            built.weights().weigh(r);
        }
    }

    /// Undoes [`Self::weigh`].
    pub fn unweigh(&self, r: &mut [f64]) {
        if let Some(built) = &self.built {
            built.weights().unweigh(r);
        }
    }

    /// Overwrites the residual `r` of a stage with γ by what settles the curvature; false if that cannot be told.
    pub fn settle(&mut self, flow: &mut GradientFlow, gamma: f64, r: &mut [f64]) -> bool {
        self.built.as_mut().is_some_and(|built| built.settle(flow, gamma, r))
    }
}
