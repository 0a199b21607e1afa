//! ESDIRK pairs; the stages are solved by the core's Newton–Krylov iteration.

use flow_core::integrator::{Counters, ErrorNorm, Exactness, NewtonKrylov, NewtonOutcome, Problem, Stage};

use super::add_scaled;
use super::one_step::Formula;
use super::tableau::EsdirkTableau;

/// A pair with its stages.
#[derive(Debug)]
pub struct Esdirk {
    tableau: &'static EsdirkTableau,
    newton: NewtonKrylov,
    /// Rates of the stages.
    rates: Vec<Vec<f64>>,
    constant: Vec<f64>,
    guess: Vec<f64>,
    stage: Vec<f64>,
    /// Whether the rate of the first stage is that of the state at hand.
    started: bool,
}

impl Esdirk {
    /// For states of `size` entries.
    #[must_use]
    pub fn new(tableau: &'static EsdirkTableau, size: usize) -> Self {
        let zero = vec![0.0; size];
        Self {
            tableau,
            newton: NewtonKrylov::new(size),
            rates: vec![zero.clone(); tableau.b.len()],
            constant: zero.clone(),
            guess: zero.clone(),
            stage: zero,
            started: false,
        }
    }
}

impl Formula for Esdirk {
    fn order(&self) -> usize {
        self.tableau.order
    }

    fn embedded_order(&self) -> usize {
        self.tableau.embedded_order
    }

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
    ) -> bool {
        let tableau = self.tableau;
        if !self.started {
            problem.rate(y, &mut self.rates[0]);
            counters.right_hand_sides += 1;
            self.started = true;
        }
        for (index, row) in tableau.a.iter().enumerate().skip(1) {
            let gamma = size * row[index];
            self.constant.copy_from_slice(y);
            for (a, rate) in row[..index].iter().zip(&self.rates) {
                add_scaled(&mut self.constant, size * a, rate);
            }
            // The rate changes little from stage to stage.
            self.guess.copy_from_slice(&self.constant);
            add_scaled(&mut self.guess, gamma, &self.rates[index - 1]);
            let exactness = Exactness { goal, residual: 1.0 };
            let stage = Stage { norm, gamma, constant: &self.constant, exactness };
            let outcome = self.newton.solve(problem, &stage, &self.guess, &mut self.stage, counters);
            if outcome != NewtonOutcome::Converged {
                return false;
            }
            let stage = self.stage.iter().zip(&self.constant);
            for (rate, (y, constant)) in self.rates[index].iter_mut().zip(stage) {
                *rate = (y - constant) / gamma;
            }
        }
        // Stiffly accurate: the last stage is the solution.
        next.copy_from_slice(&self.stage);
        error.fill(0.0);
        for ((b, embedded), rate) in tableau.b.iter().zip(tableau.b_embedded).zip(&self.rates) {
            add_scaled(error, size * (b - embedded), rate);
        }
        true
    }

    fn accepted(&mut self) {
        // The rate of the last stage is free of the modes that f(y) would blow up.
        let last = self.rates.len() - 1;
        self.rates.swap(0, last);
    }
}
