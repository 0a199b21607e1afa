//! GMRES and the preconditioners of I − γJ.

use std::ops::Range;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};
use flow_core::flow::LinearSolver;
use flow_core::integrator::{Counters, ErrorNorm, Finish, Gmres, Problem, Target};
use flow_core::operators::DerivativeFamily;
use flow_core::run::Membrane;

use crate::mobilities::{Density, Normal};
use crate::states::{State, fixed_blob, membrane, spectral};
use crate::terms::{Term, every_flow, flow, flow_under};
use crate::vectors::{distance, largest, motion, noise};

/// A linear system with a dense matrix, without a preconditioner.
struct DenseSystem(Mat<f64>);

fn target(norm: &ErrorNorm, goal: f64, reduction: f64) -> Target<'_> {
    Target { norm, goal, reduction, wanted: reduction, weighted: false }
}

impl Problem for DenseSystem {
    fn size(&self) -> usize {
        self.0.nrows()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        vec![0..self.size() / 2, self.size() / 2..self.size()]
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        for (row, out) in out.iter_mut().enumerate() {
            *out = v.iter().enumerate().map(|(column, v)| self.0[(row, column)] * v).sum();
        }
    }

    fn factorise(&mut self, _: f64) -> bool {
        true
    }

    fn precondition(&mut self, _: &mut [f64]) {}

    fn rate(&mut self, _: &[f64], _: &mut [f64]) {
        unreachable!("only linear solves")
    }

    fn linearise(&mut self, _: &[f64], _: &mut [f64]) {
        unreachable!("only linear solves")
    }

    fn finish(&mut self, _: f64, _: &mut [f64]) -> Finish {
        unreachable!("only linear solves")
    }
}

#[test]
fn gmres_finds_the_solution_of_a_dense_factorisation() {
    for size in [8, 20, 33] {
        let gamma = 0.3;
        let entries = noise(size as u64, size * size);
        let mut system = DenseSystem(Mat::from_fn(size, size, |i, j| entries[i * size + j]));
        let shifted =
            Mat::from_fn(size, size, |i, j| f64::from(u8::from(i == j)) - gamma * entries[i * size + j]);
        let mut x = noise(1, size);
        let right = Col::from_fn(size, |i| x[i]);
        let expected: Vec<f64> = shifted.partial_piv_lu().solve(&right).iter().copied().collect();
        let norm = ErrorNorm::new(&system);
        let mut counters = Counters::default();
        let solved = Gmres::new(size, size).solve(
            &mut system,
            gamma,
            target(&norm, 1e-13, 1.0),
            &mut x,
            &mut counters,
        );
        // A full Krylov space is exact up to the condition of the matrix, here below 100.
        let error = distance(&x, &expected) / largest(&expected);
        assert!(error < 1e-11, "size {size}: error {error:.1e}");
        assert!(solved.iterations <= size);
        assert_eq!(counters.krylov_iterations, solved.iterations as u64);
    }
}

#[test]
fn gmres_stops_at_the_goal() {
    let size = 40;
    let entries = noise(3, size * size);
    let mut system = DenseSystem(Mat::from_fn(size, size, |i, j| 0.1 * entries[i * size + j]));
    let norm = ErrorNorm::new(&system);
    let mut counters = Counters::default();
    let mut gmres = Gmres::new(size, size);
    let mut last = 0;
    for goal in [1e-1, 1e-4, 1e-8] {
        let right = noise(1, size);
        let mut x = right.clone();
        let solved = gmres.solve(&mut system, 1.0, target(&norm, goal, 1.0), &mut x, &mut counters);
        let mut residual = vec![0.0; size];
        system.jacobian_product(&x, &mut residual);
        for i in 0..size {
            residual[i] += right[i] - x[i];
        }
        assert!(norm.norm(&residual) <= 1.01 * goal, "goal {goal:.0e}: {:.1e}", norm.norm(&residual));
        assert!((solved.residual - norm.norm(&residual)).abs() <= 1e-2 * solved.residual);
        assert!(solved.iterations > last);
        last = solved.iterations;
    }
}

/// What is wanted beyond the goal is taken as far as there is room; the goal alone tells whether a solve has converged, and in how many
/// iterations.
#[test]
fn gmres_goes_beyond_the_goal_while_there_is_room() {
    let size = 40;
    let entries = noise(3, size * size);
    let mut system = DenseSystem(Mat::from_fn(size, size, |i, j| 0.1 * entries[i * size + j]));
    let norm = ErrorNorm::new(&system);
    let right = noise(1, size);
    let start = norm.norm(&right);
    let mut solve = |room: usize, wanted: f64| {
        let target = Target { wanted, ..target(&norm, f64::INFINITY, 0.1) };
        let mut counters = Counters::default();
        let solved =
            Gmres::new(size, room).solve(&mut system, 1.0, target, &mut right.clone(), &mut counters);
        (solved, counters.krylov_iterations)
    };
    let (plain, few) = solve(size, 0.1);
    let (better, more) = solve(size, 1e-6);
    assert!(better.converged && better.residual <= 1e-6 * start);
    assert!(more > few && better.iterations == plain.iterations);
    let (cramped, _) = solve(plain.iterations, 1e-6);
    assert!(cramped.converged && cramped.residual == plain.residual);
    assert!(!solve(plain.iterations - 1, 0.1).0.converged);
}

/// The exact inverse up to the condition of I − γJ times rounding.
#[test]
fn the_dense_preconditioner_is_the_exact_inverse() {
    for (term, family) in every_flow() {
        let state = fixed_blob().state(32, term.densities());
        let mut membrane = Membrane::new(flow(term, family, state.layout), LinearSolver::Dense, 1, 0.0);
        let gamma = 1e-3;
        let y = spectral(state.layout, &state.y);
        membrane.linearise(&y, &mut y.clone());
        assert!(membrane.factorise(gamma), "{term:?}, {family:?}");
        let x = spectral(state.layout, &motion(state.layout, 11));
        let mut product = vec![0.0; x.len()];
        membrane.jacobian_product(&x, &mut product);
        let mut r: Vec<f64> = x.iter().zip(&product).map(|(x, product)| x - gamma * product).collect();
        membrane.precondition(&mut r);
        let error = distance(&r, &x) / largest(&x);
        assert!(error < 1e-8, "{term:?}, {family:?}: {error:.1e}");
    }
}

/// The flow of `state` under `terms`, linearised and factorised there, and that state as the solvers hold it.
pub fn factorised(
    state: &State,
    normal: Normal,
    density: Density,
    solver: LinearSolver,
    family: DerivativeFamily,
    terms: [Term; 2],
    gamma: f64,
) -> (Membrane, Vec<f64>) {
    let all = terms.iter().flat_map(|term| term.build(state.layout)).collect();
    let flow = flow_under(all, family, state.layout, normal, &[density]);
    let mut membrane = Membrane::new(flow, solver, 1, 0.0);
    let y = spectral(state.layout, &state.y);
    membrane.linearise(&y, &mut y.clone());
    assert!(membrane.factorise(gamma), "{solver:?}, {family:?}, {terms:?}");
    (membrane, y)
}

/// Iterations to reduce the residual of a smooth right-hand side to 1e-6, with what is [`factorised`] for γ.
fn iterations((mut membrane, y): (Membrane, Vec<f64>), gamma: f64) -> usize {
    let mut norm = ErrorNorm::new(&membrane);
    norm.rescale(&membrane, &y);
    let mut r = vec![0.0; y.len()];
    membrane.rate(&y, &mut r);
    // A rate has the smoothness of what Newton's method solves for.
    let scale = norm.norm(&r);
    for value in &mut r {
        *value /= scale;
    }
    let mut counters = Counters::default();
    let mut gmres = Gmres::new(r.len(), MOST_ITERATIONS);
    gmres.solve(&mut membrane, gamma, target(&norm, f64::INFINITY, 1e-6), &mut r, &mut counters).iterations
}

const MOST_ITERATIONS: usize = 60;

/// Measured at the start of the three-fold membrane, with a third more; the same for every family. The last γ is
/// that of a late step, for which the banded solver is made.
#[test]
fn preconditioned_gmres_converges_in_few_iterations() {
    let bending = [Term::Bending, Term::Penalty];
    let agents = [Term::Agents, Term::Penalty];
    for (terms, solver, most) in [
        (bending, LinearSolver::Fourier, [(1e-5, 6), (1e-3, 8), (1e-1, 16)]),
        (bending, LinearSolver::Banded, [(1e-5, 6), (1e-3, 11), (1e-1, 23)]),
        (agents, LinearSolver::Fourier, [(1e-5, 12), (1e-3, 34), (1e-1, 48)]),
        (agents, LinearSolver::Banded, [(1e-5, 10), (1e-3, 19), (1e-1, 35)]),
    ] {
        for family in DerivativeFamily::ALL {
            for (gamma, most) in most {
                let (normal, density) = (Normal::Identity, Density::Diffusion);
                let prepared = factorised(&membrane(256), normal, density, solver, family, terms, gamma);
                let iterations = iterations(prepared, gamma);
                println!("{terms:?}, {family:?}, {solver:?}, γ = {gamma:.0e}: {iterations}");
                assert!(
                    iterations <= most,
                    "{terms:?}, {family:?}, {solver:?}, γ = {gamma:.0e}: {iterations}"
                );
            }
        }
    }
}

/// Every mobility costs about what plain ones do (γ = 1e-3, measured with a third more), surface diffusion up to three times as much;
/// the same for every family.
#[test]
fn preconditioners_hold_every_mobility() {
    let bending = [Term::Bending, Term::Penalty];
    let agents = [Term::Agents, Term::Penalty];
    let gamma = 1e-3;
    for family in DerivativeFamily::ALL {
        for (terms, solver, most, most_of_diffusion) in [
            (bending, LinearSolver::Fourier, 22, Some(22)),
            (bending, LinearSolver::Banded, 16, Some(24)),
            // Surface diffusion of order 8 with the agents is beyond constant coefficients.
            (agents, LinearSolver::Fourier, 55, None),
            (agents, LinearSolver::Banded, 36, Some(68)),
        ] {
            for normal in Normal::ALL {
                let most = if normal == Normal::SurfaceDiffusion { most_of_diffusion } else { Some(most) };
                let Some(most) = most else { continue };
                let density = Density::Diffusion;
                let prepared = factorised(&membrane(256), normal, density, solver, family, terms, gamma);
                let count = iterations(prepared, gamma);
                println!("{terms:?}, {normal:?}, {family:?}, {solver:?}: {count}");
                assert!(count <= most, "{terms:?}, {normal:?}, {family:?}, {solver:?}: {count}");
            }
            for density in Density::ALL {
                let normal = Normal::Identity;
                let prepared = factorised(&membrane(256), normal, density, solver, family, terms, gamma);
                let count = iterations(prepared, gamma);
                println!("{terms:?}, {density:?}, {family:?}, {solver:?}: {count}");
                assert!(count <= most, "{terms:?}, {density:?}, {family:?}, {solver:?}: {count}");
            }
        }
    }
}
