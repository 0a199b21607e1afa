//! The stiff modes of the curvature settle without a linear system.

use flow_core::flow::LinearSolver;
use flow_core::integrator::Problem;
use flow_core::operators::DerivativeFamily;
use flow_core::run::Membrane;

use crate::linear_solvers::factorised;
use crate::mobilities::{Density, Normal};
use crate::states::membrane;
use crate::terms::Term;
use crate::vectors::{largest, noise};

const GAMMA: f64 = 1e-3;

/// The three-fold membrane under `terms`, with a γ for which most of its modes are stiff.
fn stiff(terms: [Term; 2], normal: Normal, family: DerivativeFamily) -> Membrane {
    factorised(&membrane(128), normal, Density::Diffusion, LinearSolver::Banded, family, terms, GAMMA).0
}

#[test]
fn a_residual_of_stiff_modes_is_taken_back_in_the_curvature_alone() {
    for family in DerivativeFamily::ALL {
        for normal in [Normal::Identity, Normal::SurfaceDiffusion] {
            let mut membrane = stiff([Term::Agents, Term::Penalty], normal, family);
            let curvature = membrane.blocks()[0].clone();
            let mut residual = vec![0.0; membrane.size()];
            let modes = curvature.len() / 2..curvature.len() - 2;
            residual[modes.clone()].copy_from_slice(&noise(5, modes.len()));
            let mut change = residual.clone();
            change[curvature.end..].fill(f64::NAN); // what else is in the residual does not matter
            assert!(membrane.settle(GAMMA, &mut change), "{normal:?}, {family:?}");
            assert!(change[curvature.end..].iter().all(|value| *value == 0.0));
            let mut product = vec![0.0; change.len()];
            membrane.jacobian_product(&change, &mut product);
            let left: Vec<f64> = curvature.map(|k| residual[k] - change[k] + GAMMA * product[k]).collect();
            let part = largest(&left) / largest(&residual);
            println!("{normal:?}, {family:?}: {part:.2}");
            assert!(part < 0.2, "{normal:?}, {family:?}: {part:.2}");
        }
    }
}

/// Without a cost of slopes the symbol of the curvature varies along the curve.
#[test]
fn a_curvature_without_a_cost_of_slopes_does_not_settle() {
    let membrane = stiff([Term::Bending, Term::Penalty], Normal::Identity, DerivativeFamily::ALL[0]);
    let residual = noise(3, membrane.size());
    let mut change = residual.clone();
    assert!(!membrane.settle(GAMMA, &mut change));
    assert_eq!(change, residual);
}
