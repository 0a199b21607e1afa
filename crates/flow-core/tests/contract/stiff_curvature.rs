//! The stiff modes of the curvature settle without a linear system.

use std::ops::Range;

use flow_core::flow::LinearSolver;
use flow_core::integrator::Problem;
use flow_core::operators::DerivativeFamily;
use flow_core::run::Membrane;

use crate::gauges::grading;
use crate::linear_solvers::factorised;
use crate::mobilities::{Density, Normal};
use crate::states::{fixed_blob, membrane, spectral};
use crate::terms::{Term, flow_on};
use crate::vectors::{largest, noise};

const GAMMA: f64 = 1e-3;

/// The three-fold membrane under `terms`, with a γ for which most of its modes are stiff.
fn stiff(terms: [Term; 2], normal: Normal, family: DerivativeFamily) -> Membrane {
    factorised(&membrane(128), normal, Density::Diffusion, LinearSolver::Banded, family, terms, GAMMA).0
}

/// The part that is left of a residual in `modes` of the curvature; all else must stay as it is.
fn left(membrane: &mut Membrane, modes: Range<usize>) -> f64 {
    let curvature = membrane.blocks()[0].clone();
    let mut residual = vec![0.0; membrane.size()];
    let entries = 2 * modes.start..2 * modes.end;
    residual[entries.clone()].copy_from_slice(&noise(5, entries.len()));
    let mut change = residual.clone();
    change[curvature.end..].fill(f64::NAN); // what else is in the residual does not matter
    assert!(membrane.settle(GAMMA, &mut change));
    assert!(change[curvature.end..].iter().all(|value| *value == 0.0));
    let mut product = vec![0.0; change.len()];
    membrane.jacobian_product(&change, &mut product);
    let left: Vec<f64> = curvature.map(|k| residual[k] - change[k] + GAMMA * product[k]).collect();
    largest(&left) / largest(&residual)
}

#[test]
fn a_residual_of_stiff_modes_is_taken_back_in_the_curvature_alone() {
    for family in DerivativeFamily::ALL {
        for normal in [Normal::Identity, Normal::SurfaceDiffusion] {
            let part = left(&mut stiff([Term::Agents, Term::Penalty], normal, family), 32..64);
            println!("{normal:?}, {family:?}: {part:.2}");
            assert!(part < 0.2, "{normal:?}, {family:?}: {part:.2}");
        }
    }
}

/// On graded nodes the band is too far from surface diffusion for that.
#[test]
fn it_is_on_graded_nodes_too_where_there_is_a_band() {
    let grading = grading(128);
    let state = fixed_blob().graded_state(&grading, 1);
    let terms = || [Term::Agents, Term::Penalty].iter().flat_map(|term| term.build(state.layout)).collect();
    for family in DerivativeFamily::ALL {
        let built = |normal| {
            let flow = flow_on(Some(&grading), terms(), family, state.layout, normal, &[Density::Diffusion]);
            let mut membrane = Membrane::new(flow, LinearSolver::Banded, 1, 0.0);
            let y = spectral(state.layout, &state.y);
            membrane.linearise(&y, &mut y.clone());
            assert!(membrane.factorise(GAMMA), "{family:?}");
            membrane
        };
        let part = left(&mut built(Normal::Identity), 24..56);
        println!("{family:?}: {part:.2}");
        assert!(part < 0.2, "{family:?}: {part:.2}");
        let mut without = built(Normal::SurfaceDiffusion);
        let mut residual = vec![1.0; without.size()];
        assert!(!without.settle(GAMMA, &mut residual));
    }
}

/// Without a cost of slopes the symbol of the curvature varies along the curve.
#[test]
fn a_curvature_without_a_cost_of_slopes_does_not_settle() {
    let mut membrane = stiff([Term::Bending, Term::Penalty], Normal::Identity, DerivativeFamily::ALL[0]);
    let residual = noise(3, membrane.size());
    let mut change = residual.clone();
    assert!(!membrane.settle(GAMMA, &mut change));
    assert_eq!(change, residual);
}
