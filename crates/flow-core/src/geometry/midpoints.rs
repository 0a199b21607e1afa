//! Trigonometric polynomials halfway between the nodes.

use super::grid::{Complex64, PeriodicGrid};

/// The polynomial with the coefficients `spectrum` at the midpoints.
pub(super) fn at_midpoints(grid: &mut PeriodicGrid, spectrum: &[Complex64]) -> Vec<f64> {
    let half: Vec<Complex64> = spectrum.iter().enumerate().map(|(j, w)| w * half_step(grid, j)).collect();
    let mut values = vec![0.0; grid.nodes()];
    grid.synthesise(&half, &mut values);
    values
}

/// Symbol of the shift by half a node distance; the sawtooth vanishes between the nodes.
fn half_step(grid: &PeriodicGrid, mode: usize) -> Complex64 {
    if Some(mode) == grid.sawtooth_mode() {
        return Complex64::default();
    }
    Complex64::cis(0.5 * grid.wave_number(mode) / grid.nodes() as f64)
}
