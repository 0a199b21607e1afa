//! Where the points halfway between graded nodes lie on the curve.

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};

impl Grading {
    /// Fractions of the arc length at the midpoints, by the trigonometric interpolant of x − s.
    #[must_use]
    pub fn midpoint_fractions(&self) -> Vec<f64> {
        let count = self.nodes();
        let mut grid = PeriodicGrid::new(count);
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(self.shift(), &mut spectrum);
        let shift = grid.at_midpoints(&spectrum);
        shift.iter().enumerate().map(|(i, shift)| (i as f64 + 0.5) / count as f64 + shift).collect()
    }
}
