//! Rosenbrock–W pairs in the form without products of the Jacobian; each stage is one GMRES solve.
//!
//! With u = hΓk: (I − hγJ)uᵢ = hγ f(y + Σ aᵢⱼuⱼ) + γ Σ cᵢⱼuⱼ, where a = αΓ⁻¹, c = I/γ − Γ⁻¹ and the solution
//! is y + Σ mᵢuᵢ, m = bΓ⁻¹. Hairer & Wanner, Solving ODEs II (1996), section IV.7.

use flow_core::integrator::{Counters, ErrorNorm, Gmres, Problem, Target};
use nalgebra::{DMatrix, DVector};

use super::add_scaled;
use super::one_step::Formula;
use super::tableau::RosenbrockTableau;

const MOST_KRYLOV: usize = 40;
/// Each linear solve reduces its residual at least by this factor.
const KRYLOV_REDUCTION: f64 = 0.03;
/// γ may change by this factor before the preconditioner is factorised again.
const GAMMA_DRIFT: f64 = 1.35;
/// Steps after which the preconditioner is renewed in any case.
const OLDEST_FACTORISATION: usize = 30;

/// A pair with its stages.
#[derive(Debug)]
pub struct Rosenbrock {
    tableau: &'static RosenbrockTableau,
    a: DMatrix<f64>,
    c: DMatrix<f64>,
    m: DVector<f64>,
    m_error: DVector<f64>,
    gmres: Gmres,
    stages: Vec<Vec<f64>>,
    stage: Vec<f64>,
    linearised: bool,
    factorised: Option<f64>,
    age: usize,
}

impl Rosenbrock {
    /// For states of `size` entries.
    ///
    /// # Panics
    /// If the matrix of the tableau is singular, which that of no published method is.
    #[must_use]
    pub fn new(tableau: &'static RosenbrockTableau, size: usize) -> Self {
        let stages = tableau.b.len();
        let entry = |rows: &[&[f64]], i: usize, j: usize| rows[i].get(j).copied().unwrap_or(0.0);
        let diagonal = |i: usize, j: usize| if i == j { tableau.gamma } else { 0.0 };
        let inverse = DMatrix::from_fn(stages, stages, |i, j| entry(tableau.implicit, i, j) + diagonal(i, j))
            .try_inverse()
            .expect("γ > 0 on the diagonal");
        let alpha = DMatrix::from_fn(stages, stages, |i, j| entry(tableau.alpha, i, j));
        let b = DVector::from_column_slice(tableau.b);
        let b_error = &b - DVector::from_column_slice(tableau.b_embedded);
        Self {
            tableau,
            a: &alpha * &inverse,
            c: DMatrix::identity(stages, stages) / tableau.gamma - &inverse,
            m: inverse.tr_mul(&b),
            m_error: inverse.tr_mul(&b_error),
            gmres: Gmres::new(size, MOST_KRYLOV),
            stages: vec![vec![0.0; size]; stages],
            stage: vec![0.0; size],
            linearised: false,
            factorised: None,
            age: 0,
        }
    }

    fn prepare(&mut self, problem: &mut dyn Problem, y: &[f64], gamma: f64, counters: &mut Counters) -> bool {
        if !self.linearised {
            problem.linearise(y, &mut self.stage);
            self.linearised = true;
        }
        let serves =
            self.factorised.is_some_and(|old| gamma < GAMMA_DRIFT * old && old < GAMMA_DRIFT * gamma);
        if !serves || self.age >= OLDEST_FACTORISATION {
            counters.factorisations += 1;
            self.factorised = problem.factorise(gamma).then_some(gamma);
            self.age = 0;
        }
        self.factorised.is_some()
    }

    /// hγ f(y + Σ aᵢⱼuⱼ) + γ Σ cᵢⱼuⱼ into `u`.
    fn right_side(
        &mut self,
        problem: &mut dyn Problem,
        y: &[f64],
        gamma: f64,
        index: usize,
        u: &mut [f64],
        counters: &mut Counters,
    ) {
        self.stage.copy_from_slice(y);
        for (j, known) in self.stages[..index].iter().enumerate() {
            add_scaled(&mut self.stage, self.a[(index, j)], known);
        }
        problem.rate(&self.stage, u);
        counters.right_hand_sides += 1;
        for rate in u.iter_mut() {
            *rate *= gamma;
        }
        for (j, known) in self.stages[..index].iter().enumerate() {
            add_scaled(u, self.tableau.gamma * self.c[(index, j)], known);
        }
    }
}

impl Formula for Rosenbrock {
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
        let gamma = size * self.tableau.gamma;
        if !self.prepare(problem, y, gamma, counters) {
            return false;
        }
        for index in 0..self.stages.len() {
            let mut u = std::mem::take(&mut self.stages[index]);
            self.right_side(problem, y, gamma, index, &mut u, counters);
            let solved = self.gmres.solve(
                problem,
                gamma,
                Target { norm, goal, reduction: KRYLOV_REDUCTION, wanted: KRYLOV_REDUCTION, weighted: false },
                &mut u,
                counters,
            );
            let good = solved.converged;
            self.stages[index] = u;
            if problem.krylov_feedback(solved.iterations) || !good {
                self.factorised = None;
            }
            if !good || (self.factorised.is_none() && !self.prepare(problem, y, gamma, counters)) {
                return false;
            }
        }
        next.copy_from_slice(y);
        error.fill(0.0);
        for (index, u) in self.stages.iter().enumerate() {
            add_scaled(next, self.m[index], u);
            add_scaled(error, self.m_error[index], u);
        }
        true
    }

    fn accepted(&mut self) {
        self.linearised = false;
        self.age += 1;
    }
}
