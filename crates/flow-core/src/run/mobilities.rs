//! The mobilities that a scene names.

use super::scene::{self, Formula, Scene};
use super::setup_error::SetupError;
use crate::flow::{
    AreaPreserving, Carried, DensityMobility, Diffusion, Exchange, Identity, Incompressible,
    IncompressibleAreaPreserving, NormalMobility, SurfaceDiffusion, WeightedDiffusion,
};
use crate::geometry::PeriodicGrid;
use crate::operators::Derivative;

/// The normal mobility of a scene whose curve is at the start, and so for ever if length and area are kept, a circle if it `is_round`.
pub fn normal_mobility(
    scene: &Scene,
    is_round: bool,
    grid: &PeriodicGrid,
    derivative: &Derivative,
) -> Box<dyn NormalMobility> {
    let nodes = grid.nodes();
    match scene.flow.normal_mobility {
        scene::NormalMobility::Identity => Box::new(Identity),
        scene::NormalMobility::Incompressible => Box::new(Incompressible::new(derivative, nodes)),
        scene::NormalMobility::AreaPreserving => Box::new(AreaPreserving),
        scene::NormalMobility::IncompressibleAreaPreserving => {
            Box::new(IncompressibleAreaPreserving::new(derivative, nodes).holding(is_round))
        }
        scene::NormalMobility::SurfaceDiffusion => Box::new(SurfaceDiffusion::new(grid, derivative)),
    }
}

/// The mobility of each density of a scene.
///
/// # Errors
/// [`SetupError::WeightNotPositive`] if a weight is not a positive number at a flux point.
pub fn density_mobilities(
    scene: &Scene,
    grid: &PeriodicGrid,
    derivative: &Derivative,
) -> Result<Vec<Box<dyn DensityMobility>>, SetupError> {
    scene.density.iter().map(|density| density_mobility(density, grid, derivative)).collect()
}

fn density_mobility(
    density: &scene::Density,
    grid: &PeriodicGrid,
    derivative: &Derivative,
) -> Result<Box<dyn DensityMobility>, SetupError> {
    Ok(match (density.mobility, &density.weight) {
        (scene::DensityMobility::Diffusion, None) => Box::new(Diffusion::new(grid, derivative)),
        (scene::DensityMobility::Diffusion, Some(weight)) => {
            // A weight is fixed on the fractions of the arc length, which the gauges have in common.
            let points = match derivative.grading() {
                None => WeightedDiffusion::flux_points(grid, derivative),
                Some(grading) => grading.midpoint_fractions(),
            };
            let values = positive_values(&density.name, weight, &points)?;
            Box::new(WeightedDiffusion::new(grid, derivative, values))
        }
        (scene::DensityMobility::Exchange, _) => Box::new(Exchange::new(grid, derivative)),
        (scene::DensityMobility::Carried, _) => Box::new(Carried),
    })
}

fn positive_values(density: &str, weight: &Formula, points: &[f64]) -> Result<Vec<f64>, SetupError> {
    let values = weight.values(points);
    match values.iter().position(|value| !(*value > 0.0 && value.is_finite())) {
        None => Ok(values),
        Some(at) => Err(SetupError::WeightNotPositive {
            density: density.to_owned(),
            parameter: points[at],
            value: values[at],
        }),
    }
}
