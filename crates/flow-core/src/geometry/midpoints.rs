//! Trigonometric polynomials halfway between the nodes.

use super::grid::{Complex64, PeriodicGrid};

/// The polynomial with the coefficients `spectrum` at the midpoints.
pub(super) fn at_midpoints(grid: &mut PeriodicGrid, spectrum: &[Complex64]) -> Vec<f64> {
    let half: Vec<Complex64> = spectrum.iter().enumerate().map(|(j, w)| w * grid.half_step(j)).collect();
    let mut values = vec![0.0; grid.nodes()];
    grid.synthesise(&half, &mut values);
    values
}
