//! The bordered band solves the implicit system of the central family of order 2 exactly.

#![allow(clippy::unwrap_used)] // helpers of tests

use curveflow_benches::rivals::{AuxiliaryFields, Shared};
use flow_core::integrator::{Counters, ErrorNorm, Gmres, Problem, Target};
use flow_core::run::{Scene, Setup};

const CURVATURE_ALONE: &str = "
[energy]
bending = { rigidity = 1.0, preferred_curvature = 0.4 }
regularization = { delta = 0.03 }
length = { penalty = 5.0, target_ratio = 1.1 }
";
const AGENTS: &str = "
[[density]]
name = 'protein'
initial = '0.6 + 0.2*cos(4*pi*s) + 0.1*sin(2*pi*s)'
mobility = 'diffusion'
[energy.agents]
density = 'protein'
epsilon = 0.3
delta = 0.4
preferred_curvature = '1.3 - 2.0*rho'
low_density = '0.1 + 0.05*exp(-kappa^2)'
high_density = '0.8 + 0.1*exp(-kappa^2)'
[energy.bending]
rigidity = 0.7
[energy.length]
penalty = 3.0
target_ratio = 1.3
";
const BLEND: &str = "
[[density]]
name = 'a'
initial = '0.7 + 0.2*cos(4*pi*s)'
mobility = 'exchange'
[[density]]
name = 'b'
initial = '0.5 + 0.1*sin(2*pi*s)'
mobility = 'diffusion'
[energy.bending]
rigidity = 1.0
preferred_curvature = '1.0 - rho'
density = 'a'
[energy.packing]
matrix = [[1.0, 0.3], [0.3, 1.2]]
epsilon = 0.5
";

/// A scene on an asymmetric curve, with central differences of order 2.
fn scene(energies: &str, nodes: usize, derivative: &str) -> String {
    format!(
        "[curve]\nshape = 'polar'\nr = '1 + 0.2*cos(3*phi) + 0.07*sin(2*phi)'\n{energies}\n[time]\nend = 1.0\n\
         [accuracy]\nnodes = {nodes}\nderivative = '{derivative}'\nlinear_solver = 'fourier'\n"
    )
}

/// The problem, linearised at a state with random smooth changes and factorised for `gamma`; and the state.
fn factorised(text: &str, gamma: f64) -> (AuxiliaryFields, Vec<f64>) {
    let Setup { membrane, mut state, .. } = Setup::new(&Scene::parse(text, "test").unwrap()).unwrap();
    let mut problem = AuxiliaryFields::new(Shared::new(membrane));
    let mut random = Random(11);
    for block in problem.blocks() {
        let entries = block.len().min(12);
        for value in &mut state[block.start..block.start + entries] {
            *value += 0.01 * random.next();
        }
    }
    problem.finish(0.0, &mut state);
    let mut rate = state.clone();
    problem.linearise(&state, &mut rate);
    assert!(problem.factorise(gamma));
    (problem, state)
}

/// A linear congruence, to ±1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A right-hand side with all modes, those of the sine parts that nodes do not see left out.
fn right_side(problem: &AuxiliaryFields) -> Vec<f64> {
    let mut random = Random(5);
    let mut r: Vec<f64> = (0..problem.size()).map(|_| random.next()).collect();
    for block in problem.blocks().into_iter().filter(|block| block.len() > 1) {
        r[block.start + 1] = 0.0;
        r[block.end - 1] = 0.0;
    }
    r
}

fn size(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}

#[test]
fn the_exact_operator_takes_the_solution_back_to_the_right_side() {
    for energies in [CURVATURE_ALONE, AGENTS, BLEND] {
        for (nodes, gamma) in [(32, 1e-3), (64, 1e-2), (90, 1e-4)] {
            let (mut problem, _) = factorised(&scene(energies, nodes, "central-2"), gamma);
            let r = right_side(&problem);
            let (mut x, mut product) = (r.clone(), r.clone());
            problem.precondition(&mut x);
            problem.jacobian_product(&x, &mut product);
            for block in problem.blocks() {
                let residual = size(block.clone().map(|i| x[i] - gamma * product[i] - r[i]));
                let relative = residual / size(r[block].iter().copied());
                assert!(relative < 1e-8, "{nodes} nodes, γ = {gamma}: {relative:e}");
            }
        }
    }
}

#[test]
fn krylov_iterations_end_at_once_for_the_family_of_the_band() {
    for (derivative, most) in [("central-2", 2), ("central-8", 12), ("fourier", 12)] {
        let gamma = 1e-3;
        let (mut problem, y) = factorised(&scene(AGENTS, 128, derivative), gamma);
        let mut norm = ErrorNorm::new(&problem);
        norm.rescale(&problem, &y);
        let target =
            Target { norm: &norm, goal: f64::INFINITY, reduction: 1e-8, wanted: 1e-8, weighted: true };
        let mut gmres = Gmres::new(problem.size(), 40);
        let mut r = right_side(&problem);
        let solved = gmres.solve(&mut problem, gamma, target, &mut r, &mut Counters::default());
        assert!(solved.converged && solved.iterations <= most, "{derivative}: {solved:?}");
    }
}
