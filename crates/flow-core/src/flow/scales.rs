//! On which scales a state varies from place to place. See `THEORY.md`, eq. (D13).

use super::gradient_flow::GradientFlow;
use crate::geometry::vectors::multiply;
use crate::geometry::{Complex64, PeriodicGrid};

/// Wave number, per fraction of the arc length, below which nothing is told apart.
const LEAST: f64 = 4.0 * std::f64::consts::TAU;
/// Part of a field's largest value that counts as variation in any case.
const FLAT: f64 = 0.05;

/// Local wave number of the curvature and the densities at the nodes of the state that `flow` evaluated last, per fraction of
/// the arc length: k² is the largest of (φ'/a)² + |φ''|/a over the fields φ with their amplitudes a.
pub fn local_wave_numbers(flow: &mut GradientFlow) -> Vec<f64> {
    let (nodes, fields) = (flow.layout().nodes(), flow.layout().fields());
    let inverse = flow.current().grading().map(|grading| grading.inverse().to_vec());
    let mut squares = vec![LEAST * LEAST; nodes];
    let mut spectrum = vec![Complex64::default(); flow.spectral_layout().modes()];
    let (mut first, mut second) = (vec![0.0; nodes], vec![0.0; nodes]);
    for field in 0..fields {
        let values = flow.current().at_nodes(field);
        let fold = |start: f64, f: fn(f64, f64) -> f64| values.iter().copied().fold(start, f);
        let (low, high) = (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max));
        let amplitude = high - low + FLAT * high.abs().max(low.abs());
        if amplitude <= 0.0 {
            continue;
        }
        spectrum.copy_from_slice(flow.current().spectrum(field));
        let grid = flow.grid_mut();
        differentiate(grid, &mut spectrum, inverse.as_deref(), &mut first);
        grid.transform(&first, &mut spectrum);
        differentiate(grid, &mut spectrum, inverse.as_deref(), &mut second);
        for ((square, first), second) in squares.iter_mut().zip(&first).zip(&second) {
            *square = square.max((first / amplitude).powi(2) + second.abs() / amplitude);
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// Nodal values of d/dx = (1/w) d/ds of a spectrum.
fn differentiate(
    grid: &mut PeriodicGrid,
    spectrum: &mut [Complex64],
    inverse: Option<&[f64]>,
    out: &mut [f64],
) {
    for (mode, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex64::new(0.0, grid.wave_number(mode));
    }
    if let Some(sawtooth) = grid.sawtooth_mode() {
        spectrum[sawtooth] = Complex64::default();
    }
    grid.synthesise(spectrum, out);
    if let Some(inverse) = inverse {
        multiply(out, inverse);
    }
}
