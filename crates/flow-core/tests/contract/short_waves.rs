//! Products of the implicit operator are the derivative of the rate, for short waves of the curvature: whatever makes the tension.

use flow_core::flow::LinearSolver;
use flow_core::integrator::Problem;
use flow_core::operators::DerivativeFamily;
use flow_core::run::Membrane;

use crate::mobilities::{Density, Normal};
use crate::states::{fixed_blob, spectral};
use crate::terms::{Term, flow_under};
use crate::vectors::vector_difference;

const NODES: usize = 128;
/// Waves of the curvature, short against the blob's.
const MODE: usize = 40;

/// Entry of the implicit operator for the wave, and of the derivative of the rate.
fn entries(terms: &[Term], normal: Normal) -> [f64; 2] {
    let densities = terms.iter().map(|term| term.densities()).max().unwrap_or(0);
    let state = fixed_blob().state(NODES, densities);
    let all = terms.iter().flat_map(|term| term.build(state.layout)).collect();
    let mobilities = vec![Density::Diffusion; densities];
    let flow = flow_under(all, DerivativeFamily::Fourier, state.layout, normal, &mobilities);
    let mut membrane = Membrane::new(flow, LinearSolver::Fourier, 1, 0.0);
    let y = spectral(state.layout, &state.y);
    membrane.linearise(&y, &mut y.clone());
    let (mut wave, mut product) = (vec![0.0; y.len()], vec![0.0; y.len()]);
    wave[2 * MODE] = 1.0;
    membrane.jacobian_product(&wave, &mut product);
    let derivative = vector_difference(|step| {
        let moved: Vec<f64> = y.iter().zip(&wave).map(|(y, wave)| y + step * wave).collect();
        let mut rate = vec![0.0; y.len()];
        membrane.rate(&moved, &mut rate);
        rate
    });
    [product[2 * MODE], derivative[2 * MODE]]
}

/// Tension alone moves these waves, at a rate of order 2: what J lacks is of order 1 and less.
#[test]
fn tension_counts_whatever_stands_beside_it() {
    for beside in [None, Some(Term::Pressure), Some(Term::AreaPenalty), Some(Term::Adhesion)] {
        let terms: Vec<Term> = [Term::Tension].into_iter().chain(beside).collect();
        for normal in [Normal::Identity, Normal::AreaPreserving, Normal::SurfaceDiffusion] {
            let [product, derivative] = entries(&terms, normal);
            println!("{terms:?}, {normal:?}: {product:.4e}, {derivative:.4e}");
            assert!(
                (product / derivative - 1.0).abs() < 0.02,
                "{terms:?}, {normal:?}: {product} {derivative}"
            );
        }
    }
}

/// What holds every piece of the curve against positions is a tension too.
#[test]
fn what_holds_the_length_against_pressure_counts() {
    for normal in [Normal::Incompressible, Normal::IncompressibleAreaPreserving] {
        for beside in [Term::Pressure, Term::AreaPenalty, Term::Adhesion] {
            let terms = [Term::Tension, beside];
            let [product, derivative] = entries(&terms, normal);
            println!("{terms:?}, {normal:?}: {product:.4e}, {derivative:.4e}");
            // Pressure alone moves nothing where the area is held.
            let error = (product - derivative).abs();
            assert!(error < 0.02 * derivative.abs() + 1e-2, "{terms:?}, {normal:?}: {product} {derivative}");
        }
    }
}
