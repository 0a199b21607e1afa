//! Derivative families against stencils written as loops.

use std::f64::consts::TAU;

use flow_core::geometry::{Complex64, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};

use crate::vectors::{distance, largest, noise};

/// Weights of f(i + 1 + j) − f(i − j), and of half the sums of the same pairs.
fn weights(family: DerivativeFamily) -> Option<(Vec<f64>, Vec<f64>)> {
    let pairs = match family {
        DerivativeFamily::Fourier => return None,
        DerivativeFamily::Central2 => 1,
        DerivativeFamily::Central4 => 2,
        DerivativeFamily::Central6 => 3,
        DerivativeFamily::Central8 => 4,
    };
    // Lagrange's polynomial through the points x = ±1/2, ±3/2, …, differentiated and evaluated at 0.
    let odd = |j: usize| (2 * j + 1) as f64;
    let others = |j: usize| {
        (0..pairs).filter(move |k| *k != j).map(move |k| odd(k).powi(2) / (odd(k).powi(2) - odd(j).powi(2)))
    };
    let mean: Vec<f64> = (0..pairs).map(|j| others(j).product()).collect();
    let difference = mean.iter().enumerate().map(|(j, mean)| mean / odd(j)).collect();
    Some((difference, mean))
}

/// Applies a symbol.
fn apply(grid: &mut PeriodicGrid, values: &[f64], symbol: impl Fn(usize) -> Complex64) -> Vec<f64> {
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(values, &mut spectrum);
    spectrum.iter_mut().enumerate().for_each(|(mode, value)| *value *= symbol(mode));
    let mut out = vec![0.0; values.len()];
    grid.synthesise(&spectrum, &mut out);
    out
}

const NODES: [usize; 5] = [32, 48, 64, 65, 96];

/// Rounding of a transform and back, relative to the largest value.
const ROUNDING: f64 = 1e-14;

#[test]
fn symbols_are_those_of_the_stencils() {
    for nodes in NODES {
        let mut grid = PeriodicGrid::new(nodes);
        let f = noise(nodes as u64, nodes);
        let at = |i: usize, offset: isize| f[(i as isize + offset).rem_euclid(nodes as isize) as usize];
        for family in DerivativeFamily::ALL {
            let Some((difference, mean)) = weights(family) else { continue };
            let derivative = Derivative::new(family, &grid);
            let interpolation = derivative.interpolation().expect("flux points are midpoints");
            let (mut slope, mut middle) = (vec![0.0; nodes], vec![0.0; nodes]);
            for i in 0..nodes {
                for (j, (difference, mean)) in difference.iter().zip(&mean).enumerate() {
                    let (right, left) = (at(i, 1 + j as isize), at(i, -(j as isize)));
                    slope[i] += nodes as f64 * difference * (right - left);
                    middle[i] += 0.5 * mean * (right + left);
                }
            }
            let by_symbol = apply(&mut grid, &f, |mode| derivative.to_flux()[mode]);
            assert!(distance(&by_symbol, &slope) <= ROUNDING * largest(&slope), "{family:?}, n = {nodes}");
            let by_symbol = apply(&mut grid, &f, |mode| interpolation[mode]);
            assert!(distance(&by_symbol, &middle) <= ROUNDING * largest(&middle), "{family:?}, n = {nodes}");
        }
    }
}

#[test]
fn the_derivative_to_the_flux_points_is_minus_the_transpose_of_the_one_back() {
    for nodes in NODES {
        let mut grid = PeriodicGrid::new(nodes);
        let (f, g) = (noise(1, nodes), noise(2, nodes));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        for family in DerivativeFamily::ALL {
            let derivative = Derivative::new(family, &grid);
            let plus = apply(&mut grid, &f, |mode| derivative.to_flux()[mode]);
            let minus = apply(&mut grid, &g, |mode| -derivative.to_flux()[mode].conj());
            let scale = (dot(&plus, &plus) * dot(&g, &g)).sqrt();
            assert!((dot(&plus, &g) + dot(&f, &minus)).abs() <= ROUNDING * scale, "{family:?}, n = {nodes}");
        }
    }
}

#[test]
fn the_second_derivative_is_symmetric_and_vanishes_on_constants_only() {
    for nodes in NODES {
        let grid = PeriodicGrid::new(nodes);
        for family in DerivativeFamily::ALL {
            let derivative = Derivative::new(family, &grid);
            let symbol = derivative.minus_laplacian();
            assert_eq!(symbol[0], 0.0, "{family:?}, n = {nodes}");
            assert!(symbol[1..].iter().all(|symbol| *symbol > 1.0), "{family:?}, n = {nodes}");
        }
    }
}

/// Largest errors of the slope, of the value between the nodes and of the second derivative of exp(sin 2πs).
fn errors(family: DerivativeFamily, nodes: usize) -> [f64; 3] {
    let mut grid = PeriodicGrid::new(nodes);
    let derivative = Derivative::new(family, &grid);
    let shift = if derivative.interpolation().is_some() { 0.5 } else { 0.0 };
    let sample = |f: &dyn Fn(f64) -> f64, shift: f64| -> Vec<f64> {
        (0..nodes).map(|i| f(TAU * (i as f64 + shift) / nodes as f64)).collect()
    };
    let value = |x: f64| x.sin().exp();
    let slope = |x: f64| TAU * x.cos() * x.sin().exp();
    let second = |x: f64| TAU * TAU * (x.cos().powi(2) - x.sin()) * x.sin().exp();
    let f = sample(&value, 0.0);
    let interpolated = match derivative.interpolation() {
        Some(symbol) => apply(&mut grid, &f, |mode| symbol[mode]),
        None => f.clone(),
    };
    [
        distance(&apply(&mut grid, &f, |mode| derivative.to_flux()[mode]), &sample(&slope, shift)),
        distance(&interpolated, &sample(&value, shift)),
        distance(
            &apply(&mut grid, &f, |mode| Complex64::from(-derivative.minus_laplacian()[mode])),
            &sample(&second, 0.0),
        ),
    ]
}

#[test]
fn errors_fall_at_the_order_of_the_family() {
    for family in DerivativeFamily::ALL {
        let Some(order) = family.order() else { continue };
        let (coarse, fine) = (errors(family, 64), errors(family, 128));
        for (coarse, fine) in coarse.iter().zip(fine) {
            let measured = (coarse / fine).log2();
            // At 64 nodes the next term of the expansion still shows.
            assert!((measured - f64::from(order)).abs() < 0.15, "{family:?}: order {measured:.2}");
        }
    }
}

#[test]
fn the_fourier_derivative_is_exact_once_the_function_is_resolved() {
    let [slope, _, second] = errors(DerivativeFamily::Fourier, 48);
    // Rounding times the largest wave number, once and squared.
    assert!(slope < 1e-12 && second < 1e-10, "{slope:.1e}, {second:.1e}");
}
