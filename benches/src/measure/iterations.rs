//! Krylov iterations of one system with a fresh factorisation, against γ.

use flow_core::integrator::{Counters, ErrorNorm, Gmres, Target};

use super::case::{AUXILIARY, Case};
use super::method::Method;

/// γ of the systems.
pub const GAMMAS: [f64; 5] = [1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// Solvers compared.
pub const SOLVERS: [&str; 3] = ["fourier", "banded", AUXILIARY];
/// Part of itself below which the residual shall fall.
pub const REDUCTION: f64 = 1e-4;

const MOST: usize = 100;
/// The state is that of a run with the Fourier derivative, whatever the family of the system.
const TOLERANCE: f64 = 1e-5;
const LIMIT: f64 = 60.0;

/// Iterations by [`GAMMAS`] and [`SOLVERS`] for x = γ × rate at the state of `case` at `time`.
#[must_use]
pub fn iterations(case: Case, time: f64) -> Vec<[usize; SOLVERS.len()]> {
    let run = Method::Bdf.run(Case { derivative: "fourier", ..case }, "auto", TOLERANCE, time, LIMIT);
    GAMMAS.into_iter().map(|gamma| SOLVERS.map(|solver| count(case, solver, gamma, &run.state))).collect()
}

fn count(case: Case, solver: &str, gamma: f64, y: &[f64]) -> usize {
    let (mut problem, ..) = case.problem(solver);
    let mut norm = ErrorNorm::new(&*problem);
    norm.rescale(&*problem, y);
    let mut r = y.to_vec();
    problem.linearise(y, &mut r);
    assert!(problem.factorise(gamma), "the shipped scenes have no singular systems");
    for r in &mut r {
        *r *= gamma;
    }
    let target =
        Target { norm: &norm, goal: f64::INFINITY, reduction: REDUCTION, wanted: REDUCTION, weighted: true };
    let mut gmres = Gmres::new(y.len(), MOST);
    gmres.solve(&mut *problem, gamma, target, &mut r, &mut Counters::default()).iterations
}
