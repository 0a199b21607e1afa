//! Trigonometric polynomials halfway between the nodes.

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};

/// The polynomial with the coefficients `spectrum` at the midpoints.
pub(super) fn at_midpoints(grid: &mut PeriodicGrid, spectrum: &[Complex64]) -> Vec<f64> {
    let half: Vec<Complex64> = spectrum.iter().enumerate().map(|(j, w)| w * grid.half_step(j)).collect();
    let mut values = vec![0.0; grid.nodes()];
    grid.synthesise(&half, &mut values);
    values
}

impl Grading {
    /// Fractions of the arc length at the midpoints, by the trigonometric interpolant of x − s.
    #[must_use]
    pub fn midpoint_fractions(&self) -> Vec<f64> {
        let count = self.nodes();
        let mut grid = PeriodicGrid::new(count);
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(self.shift(), &mut spectrum);
        let shift = at_midpoints(&mut grid, &spectrum);
        shift.iter().enumerate().map(|(i, shift)| (i as f64 + 0.5) / count as f64 + shift).collect()
    }
}
