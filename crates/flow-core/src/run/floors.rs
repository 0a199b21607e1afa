//! What relative errors of a state are relative to at least.

/// Part of full coverage that a density counts as at least; where errors of a finished run are measured, of the largest that it was.
pub(super) const LEAST_PART_OF_DENSITY: f64 = 1e-3;

/// Mean square that field `field` of a spectral state of a curve of length `length` counts as at least, the curvature being the first
/// and the densities next: a turn of the tangent per length, a thousandth of full coverage.
pub(super) fn least_mean_square(field: usize, length: f64) -> f64 {
    if field == 0 { 1.0 } else { (LEAST_PART_OF_DENSITY * length).powi(2) }
}
