//! A cost of slopes that vanishes at some states: what a preconditioner takes from one state must not depend on those before, or a
//! resumed run would not go on as the unbroken one.

use flow_core::energies::{Bending, EnergyTerm, Local};
use flow_core::expression::Expression;
use flow_core::flow::{GradientFlow, LinearSolver, Preconditioner};
use flow_core::geometry::Layout;
use flow_core::operators::DerivativeFamily;

use crate::gauges::grading;
use crate::mobilities::{Density, Normal};
use crate::states::{State, fixed_blob, spectral};
use crate::terms::flow_on;
use crate::vectors::noise;

const GAMMA: f64 = 1e-3;

/// ∫(κ²/2 + ρ|`∇_sκ`|²) dσ: the curvature has no cost of slopes where ρ = 0.
fn terms(nodes: usize) -> Vec<Box<dyn EnergyTerm>> {
    let density = Expression::parse("r*u^2", &["k", "r", "u", "v"]).expect("a formula");
    vec![Box::new(Bending::new(1.0)), Box::new(Local::new(&density, 2, nodes).expect("short derivatives"))]
}

/// A residual after each part of the preconditioner at the last of `states`, built at the first of them.
fn parts(flow: &mut GradientFlow, solver: LinearSolver, states: &[&[f64]]) -> [Option<Vec<f64>>; 3] {
    flow.spectral_linearise(states[0]);
    let mut preconditioner = Preconditioner::new(solver, flow);
    for state in states {
        flow.spectral_linearise(state);
        preconditioner.factorise(flow, GAMMA).expect("no vanishing pivot");
    }
    let residual = noise(3, states[0].len());
    let [mut applied, mut weighed, mut settled] = [0; 3].map(|_| residual.clone());
    preconditioner.apply(flow, &mut applied);
    preconditioner.weights().weigh(&mut weighed);
    let settles = preconditioner.settle(flow, GAMMA, &mut settled);
    [Some(applied), Some(weighed), settles.then_some(settled)]
}

#[test]
fn what_came_before_does_not_matter() {
    let grading = grading(64);
    let uniform = fixed_blob().state(64, 1);
    let graded = fixed_blob().graded_state(&grading, 1);
    for (State { layout, y }, grading) in [(uniform, None), (graded, Some(&grading))] {
        let stiff = spectral(layout, &y);
        let soft = spectral(layout, &without_density(layout, &y));
        for solver in [LinearSolver::Fourier, LinearSolver::Banded] {
            let family = DerivativeFamily::Fourier;
            let densities = [Density::Exchange];
            let mut flow = flow_on(grading, terms(64), family, layout, Normal::Identity, &densities);
            let at_soft = parts(&mut flow, solver, &[&soft]);
            assert_eq!(at_soft, parts(&mut flow, solver, &[&stiff, &soft]), "{solver:?}");
            assert!(at_soft[1].as_ref() == Some(&noise(3, stiff.len())), "no weights without a cost");
            assert!(at_soft[2].is_none(), "what settles at no cost is what has a cost of slopes");
            let at_stiff = parts(&mut flow, solver, &[&stiff]);
            assert_eq!(at_stiff, parts(&mut flow, solver, &[&soft, &stiff]), "{solver:?}");
            assert!(at_stiff[2].is_some());
        }
    }
}

fn without_density(layout: Layout, y: &[f64]) -> Vec<f64> {
    let mut y = y.to_vec();
    y[layout.field(1)].fill(0.0);
    y
}
