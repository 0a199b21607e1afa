//! The Helmholtz operator −`Δ_s` + κ².

use std::f64::consts::TAU;
use std::sync::Arc;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};
use flow_core::geometry::{Grading, PeriodicGrid};
use flow_core::operators::{CurveHelmholtz, Derivative, DerivativeFamily, Helmholtz, HelmholtzError};

use crate::refusals::panics;
use crate::vectors::{distance, largest, noise};

const LENGTH: f64 = 7.5;

fn curvature(nodes: usize) -> Vec<f64> {
    let value = |s: f64| 0.8 + 1.6 * (3.0 * s).cos() + 0.3 * (7.0 * s + 0.2).sin();
    (0..nodes).map(|i| value(TAU * i as f64 / nodes as f64)).collect()
}

/// On constant curvature the solution of a mode is known from the symbol: the forward error, not the residual.
#[test]
fn smooth_modes_are_solved_to_rounding_on_many_nodes() {
    for family in DerivativeFamily::ALL {
        for nodes in [32, 255, 511, 512, 1024, 8192] {
            let kappa = TAU / LENGTH;
            let mut helmholtz = Helmholtz::new(family, nodes);
            helmholtz.set(&vec![kappa; nodes], LENGTH).unwrap();
            let mut worst: f64 = 0.0;
            for mode in [0, 1, 2, 5, 13] {
                let exact: Vec<f64> = (0..nodes)
                    .map(|i| (TAU * ((mode * i) % nodes) as f64 / nodes as f64 + 0.3).cos())
                    .collect();
                let symbol = helmholtz.minus_laplacian(mode) / (LENGTH * LENGTH) + kappa * kappa;
                let f: Vec<f64> = exact.iter().map(|x| symbol * x).collect();
                let mut u = vec![f64::NAN; nodes];
                helmholtz.solve(&f, &mut u);
                worst = worst.max(distance(&u, &exact));
            }
            println!("{family:?}, n = {nodes}: {worst:.1e}");
            // With refinement, the rounding of f, 1e-16 symbol/κ²; without, that of the assembled band, 1e-16 n²/L²κ².
            let bound = if nodes < 512 { 3e-12 } else { 3e-14 };
            assert!(worst <= bound, "{family:?}, n = {nodes}: {worst:.1e}");
        }
    }
}

#[test]
fn one_is_mapped_to_the_square_of_the_curvature() {
    for family in DerivativeFamily::ALL {
        for nodes in [32, 255, 1024, 8192] {
            let kappa = curvature(nodes);
            let mut helmholtz = Helmholtz::new(family, nodes);
            helmholtz.set(&kappa, LENGTH).unwrap();
            let f: Vec<f64> = kappa.iter().map(|kappa| kappa * kappa).collect();
            let mut u = vec![f64::NAN; nodes];
            helmholtz.solve(&f, &mut u);
            let error = distance(&u, &vec![1.0; nodes]);
            println!("{family:?}, n = {nodes}: {error:.1e}");
            assert!(error < 1e-12, "{family:?}, n = {nodes}: {error:.1e}");
        }
    }
}

/// The dense matrix Fᵀ(k²)F + κ² by the symbol.
#[test]
fn solutions_are_those_of_a_dense_factorisation() {
    for family in DerivativeFamily::ALL {
        for nodes in [24, 33, 64] {
            let kappa = curvature(nodes);
            let mut helmholtz = Helmholtz::new(family, nodes);
            helmholtz.set(&kappa, LENGTH).unwrap();
            let entry = |distance: usize| -> f64 {
                let wave = |m: usize| (TAU * ((m * distance) % nodes) as f64 / nodes as f64).cos();
                let sum: f64 = (0..nodes).map(|m| helmholtz.minus_laplacian(m) * wave(m)).sum();
                sum / (nodes as f64 * LENGTH * LENGTH)
            };
            let row: Vec<f64> = (0..nodes).map(entry).collect();
            let matrix = Mat::from_fn(nodes, nodes, |i, j| {
                row[i.abs_diff(j)] + if i == j { kappa[i] * kappa[i] } else { 0.0 }
            });
            let f = noise(3, nodes);
            let right = Col::from_fn(nodes, |i| f[i]);
            let expected: Vec<f64> = matrix.partial_piv_lu().solve(&right).iter().copied().collect();
            let mut u = vec![f64::NAN; nodes];
            helmholtz.solve(&f, &mut u);
            let error = distance(&u, &expected) / largest(&expected);
            assert!(error < 1e-11, "{family:?}, n = {nodes}: {error:.1e}");
        }
    }
}

#[test]
fn the_second_difference_is_that_of_the_family() {
    let nodes = 96;
    let grid = PeriodicGrid::new(nodes);
    for family in DerivativeFamily::ALL {
        let derivative = Derivative::new(family, &grid);
        let helmholtz = Helmholtz::new(family, nodes);
        for mode in 0..grid.modes() {
            let (ours, theirs) = (helmholtz.minus_laplacian(mode), derivative.minus_laplacian()[mode]);
            // The compact difference of order 8 has the error 1.7e-5 ω⁸.
            let angle = TAU * mode as f64 / nodes as f64;
            let bound = if family == DerivativeFamily::Fourier { 3e-5 * angle.powi(8) } else { 0.0 };
            assert!(
                (ours - theirs).abs() <= (1e-13 + bound) * theirs,
                "{family:?}, mode {mode}: {ours} ≠ {theirs}"
            );
        }
    }
}

#[test]
fn a_line_has_no_inverse() {
    let mut helmholtz = Helmholtz::new(DerivativeFamily::Fourier, 32);
    for kappa in [0.0, 1e-9] {
        let error = helmholtz.set(&[kappa; 32], LENGTH).expect_err("no closed curve");
        assert!(matches!(error, HelmholtzError::NoCurvature { .. }), "{error}");
    }
    for kappa in [f64::NAN, f64::INFINITY, 1e200] {
        let error = helmholtz.set(&[kappa; 32], LENGTH).expect_err("no curve");
        assert!(matches!(error, HelmholtzError::NotFinite { .. }), "{error}");
    }
    assert_eq!(helmholtz.set(&[TAU / LENGTH; 32], LENGTH), Ok(()));
}

/// On uniform and on graded nodes.
fn operators(nodes: usize) -> [(CurveHelmholtz, Option<Arc<Grading>>); 2] {
    let grid = PeriodicGrid::new(nodes);
    let weight = |i: usize| 1.0 + 0.3 * (TAU * i as f64 / Grading::samples(nodes) as f64).cos();
    let samples: Vec<f64> = (0..Grading::samples(nodes)).map(weight).collect();
    let grading = Arc::new(Grading::new(&samples).expect("smooth"));
    [None, Some(grading)].map(|grading| {
        let derivative = Derivative::graded(DerivativeFamily::Central8, &grid, grading.clone());
        (CurveHelmholtz::new(&derivative, nodes), grading)
    })
}

#[test]
fn what_is_no_length_is_refused() {
    for (mut helmholtz, grading) in operators(32) {
        for length in [-LENGTH, 0.0, f64::NAN, f64::INFINITY] {
            let error = helmholtz.set(grading.as_deref(), &[1.0; 32], length).expect_err("no length");
            assert!(matches!(error, HelmholtzError::NoLength { .. }), "{error}");
        }
    }
}

#[test]
fn other_numbers_of_values_are_refused() {
    for nodes in [32, 600] {
        for (mut helmholtz, grading) in operators(nodes) {
            for found in [7, nodes + 1] {
                panics("one curvature per node", || {
                    _ = helmholtz.set(grading.as_deref(), &vec![1.0; found], LENGTH);
                });
                helmholtz.set(grading.as_deref(), &vec![1.0; nodes], LENGTH).unwrap();
                let (short, mut whole) = (vec![1.0; found], vec![0.0; nodes]);
                panics("one value per node", || helmholtz.solve(&short, &mut whole));
                panics("one value per node", || helmholtz.solve(&whole.clone(), &mut vec![0.0; found]));
            }
        }
    }
    panics("21 nodes at least", || _ = Helmholtz::new(DerivativeFamily::Fourier, 20));
}

/// No answer of a state that was given before, and none at all before the first.
#[test]
fn only_what_was_factorised_is_solved() {
    for (mut helmholtz, grading) in operators(32) {
        let mut u = vec![0.0; 32];
        panics("not factorised", || helmholtz.solve(&[1.0; 32], &mut u));
        helmholtz.set(grading.as_deref(), &[1.0; 32], LENGTH).unwrap();
        helmholtz.solve(&[1.0; 32], &mut u);
        helmholtz.set(grading.as_deref(), &[0.0; 32], LENGTH).unwrap_err();
        panics("not factorised", || helmholtz.solve(&[1.0; 32], &mut u));
    }
}
