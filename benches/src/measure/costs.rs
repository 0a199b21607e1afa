//! Times of the parts of a step against the number of nodes.

use std::time::Instant;

use flow_core::integrator::Problem;
use flow_core::run::Setup;

use super::case::Case;
use super::iterations::SOLVERS;
use super::method::Method;
use super::outcome::Outcome;

/// Numbers of nodes measured.
pub const SIZES: [usize; 9] = [64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384];

const SCENE: &str = "three_fold";
const TOLERANCE: f64 = 1e-5;
const END: f64 = 0.1;
const LIMIT: f64 = 60.0;
const GAMMA: f64 = 1e-4;
/// Each time is the least of these many batches of at least so many seconds.
const BATCHES: usize = 20;
const BATCH_SECONDS: f64 = 0.002;
/// Runs are repeated until they add up to so many seconds.
const REPEATED: f64 = 1.0;

/// Times in seconds on one number of nodes.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// Number of nodes.
    pub nodes: usize,
    /// One right-hand side.
    pub rate: f64,
    /// One linearisation.
    pub linearisation: f64,
    /// One product of the implicit operator with a vector.
    pub product: f64,
    /// One solve with each preconditioner of [`SOLVERS`].
    pub solve: [f64; SOLVERS.len()],
    /// One factorisation of each; that of the auxiliary fields includes the one by Fourier, for its weights of residuals.
    pub factorisation: [f64; SOLVERS.len()],
    /// One accepted step of BDF to t = 0.1, all included.
    pub step: f64,
    /// That whole run.
    pub solve_to_end: f64,
    /// Accepted steps of that run.
    pub steps: u64,
    /// Krylov iterations per step of that run.
    pub krylov_per_step: f64,
}

/// Measures the parts on `nodes` nodes.
#[must_use]
pub fn costs(nodes: usize) -> Costs {
    let case = Case { scene: SCENE, nodes, derivative: "fourier" };
    let Setup { mut membrane, state, .. } = case.build("fourier");
    let mut out = vec![0.0; state.len()];
    let rate = seconds(|| membrane.rate(&state, &mut out));
    let linearisation = seconds(|| membrane.linearise(&state, &mut out));
    let v = out.clone();
    let product = seconds(|| membrane.jacobian_product(&v, &mut out));
    let mut solve = [0.0; SOLVERS.len()];
    let mut factorisation = solve;
    for (index, solver) in SOLVERS.into_iter().enumerate() {
        let (mut problem, ..) = case.problem(solver);
        problem.linearise(&state, &mut out);
        factorisation[index] = seconds(|| {
            problem.factorise(GAMMA);
        });
        solve[index] = seconds(|| {
            out.copy_from_slice(&v);
            problem.precondition(&mut out);
        });
    }
    let (run, run_seconds) = solve_to_end(case);
    let steps = run.counters.steps;
    Costs {
        nodes,
        rate,
        linearisation,
        product,
        solve,
        factorisation,
        step: run_seconds / steps as f64,
        solve_to_end: run_seconds,
        steps,
        krylov_per_step: run.counters.krylov_iterations as f64 / steps as f64,
    }
}

/// A run of BDF, and its time: the mean over repeats, the resolution of the clock being a few milliseconds.
fn solve_to_end(case: Case) -> (Outcome, f64) {
    let solve = || Method::Bdf.run(case, "auto", TOLERANCE, END, LIMIT);
    let mut last = solve();
    let (mut total, mut runs) = (last.seconds, 1.0);
    while total < REPEATED {
        last = solve();
        total += last.seconds;
        runs += 1.0;
    }
    (last, total / runs)
}

/// The least time of one call over several batches: the machine may be busy with others.
pub(super) fn seconds(mut call: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..BATCHES {
        let (clock, mut calls) = (Instant::now(), 0);
        while clock.elapsed().as_secs_f64() < BATCH_SECONDS {
            call();
            calls += 1;
        }
        best = best.min(clock.elapsed().as_secs_f64() / f64::from(calls));
    }
    best
}

/// Least-squares power of N in pairs of N and a cost.
#[must_use]
pub fn exponent(pairs: &[(f64, f64)]) -> f64 {
    let count = pairs.len() as f64;
    let mean_x = pairs.iter().map(|(x, _)| x.ln()).sum::<f64>() / count;
    let mean_y = pairs.iter().map(|(_, y)| y.ln()).sum::<f64>() / count;
    let covariance: f64 = pairs.iter().map(|(x, y)| (x.ln() - mean_x) * (y.ln() - mean_y)).sum();
    covariance / pairs.iter().map(|(x, _)| (x.ln() - mean_x).powi(2)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_exponent_of_a_power_is_found() {
        let pairs: Vec<_> = [2.0_f64, 3.0, 7.0].map(|n| (n, 5.0 * n.powf(1.25))).into();
        assert!((super::exponent(&pairs) - 1.25).abs() < 1e-12);
    }
}
