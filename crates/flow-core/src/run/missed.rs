//! What the nodes miss of the initial data between them. See `THEORY.md`, eq. (D15).

use super::floors::least_mean_square;
use super::scene::Scene;
use crate::geometry::shapes::{ByArcLength, ShapeError};
use crate::geometry::vectors::{mean_of_product, multiply};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid, ScatteredPoints, SpectralLayout};

/// Points at which curve and densities are looked at: a place on the curve costs fifty times one in a formula.
const CURVE_PLACES: usize = 256;
const DENSITY_PLACES: usize = 4096;
/// Part of the distance between two of them by which all are shifted: no waves look alike at nodes and places so far apart.
const SHIFT: f64 = 0.381_966_011_250_105_2;

/// Part of the initial data, the largest over curvature and densities, by which the interpolant of the spectral `state` on `layout`
/// differs from them between its nodes: in the root mean square, relative to the field as `resolution::unresolved` is. The spectrum
/// alone does not know: waves shorter than the nodes look like longer ones there.
///
/// # Errors
/// [`ShapeError`] as for the nodes.
pub(super) fn missed(
    scene: &Scene,
    curve: &ByArcLength,
    layout: Layout,
    state: &[f64],
    grading: Option<&Grading>,
) -> Result<f64, ShapeError> {
    let length = curve.length();
    let mut turning = Places::new(CURVE_PLACES, layout.nodes(), grading);
    let curvature = curve.at(&turning.fractions)?.curvature;
    let turns: Vec<f64> = curvature.iter().map(|kappa| kappa * length).collect();
    let mut worst = turning.miss(layout, state, 0, &turns, least_mean_square(0, length));
    if !scene.density.is_empty() {
        let mut places = Places::new(DENSITY_PLACES, layout.nodes(), grading);
        let has_lists = scene.density.iter().any(|density| density.initial.formula().is_none());
        let belong_to_points = has_lists && scene.curve.points().is_some();
        let there = belong_to_points.then(|| curve.at(&places.fractions)).transpose()?;
        for (index, density) in scene.density.iter().enumerate() {
            let of_lists = there.as_ref().map_or(&places.fractions, |curve| &curve.parameter);
            let values = density.initial.values(&places.fractions, of_lists);
            let masses: Vec<f64> = values.iter().map(|rho| rho * length).collect();
            let floor = least_mean_square(1 + index, length);
            worst = f64::max(worst, places.miss(layout, state, 1 + index, &masses, floor));
        }
    }
    Ok(worst)
}

/// Parameters apart from the nodes, and what is known there.
struct Places {
    points: ScatteredPoints,
    /// Fractions of the arc length.
    fractions: Vec<f64>,
    /// 1/w, where the nodes are graded.
    inverse: Option<Vec<f64>>,
}

impl Places {
    /// `count` of them, for polynomials on `nodes` nodes.
    fn new(count: usize, nodes: usize, grading: Option<&Grading>) -> Self {
        let mut fractions: Vec<f64> = (0..count).map(|i| (i as f64 + SHIFT) / count as f64).collect();
        let mut points = ScatteredPoints::new(nodes, &fractions);
        let inverse = grading.map(|grading| {
            let mut grid = PeriodicGrid::new(nodes);
            let mut spectrum = vec![Complex64::default(); grid.modes()];
            let mut between = |values: &[f64]| {
                grid.transform(values, &mut spectrum);
                points.values(&spectrum)
            };
            let shift = between(grading.shift());
            fractions.iter_mut().zip(&shift).for_each(|(x, shift)| *x += shift);
            between(grading.weight()).iter().map(|w| w.recip()).collect()
        });
        Self { points, fractions, inverse }
    }

    /// The root mean square of what field `field` of the spectral `state` differs by from `data`, relative to those, whose mean
    /// square counts as `floor` at least.
    fn miss(&mut self, layout: Layout, state: &[f64], field: usize, data: &[f64], floor: f64) -> f64 {
        let spectral = SpectralLayout::new(layout);
        let mut values = self.points.values(&spectral.spectra(state)[spectral.spectrum(field)]);
        if let Some(inverse) = &self.inverse {
            multiply(&mut values, inverse);
        }
        values.iter_mut().zip(data).for_each(|(value, exact)| *value -= exact);
        (mean_of_product(&values, &values) / mean_of_product(data, data).max(floor)).sqrt()
    }
}
