//! The mobilities that a scene names.

use super::scene::{self, Formula, Scene};
use super::setup_error::SetupError;
use crate::expression::Program;
use crate::flow::{
    AreaPreserving, Carried, DensityMobility, Diffusion, Exchange, Identity, Incompressible,
    IncompressibleAreaPreserving, NormalMobility, SurfaceDiffusion, WeightedDiffusion,
};
use crate::geometry::PeriodicGrid;
use crate::operators::Derivative;

/// The normal mobility of a scene.
pub fn normal_mobility(
    mobility: scene::NormalMobility,
    grid: &PeriodicGrid,
    derivative: &Derivative,
) -> Box<dyn NormalMobility> {
    let (family, nodes) = (derivative.family(), grid.nodes());
    match mobility {
        scene::NormalMobility::Identity => Box::new(Identity),
        scene::NormalMobility::Incompressible => Box::new(Incompressible::new(family, nodes)),
        scene::NormalMobility::AreaPreserving => Box::new(AreaPreserving),
        scene::NormalMobility::IncompressibleAreaPreserving => {
            Box::new(IncompressibleAreaPreserving::new(family, nodes))
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
        (scene::DensityMobility::Diffusion, None) => Box::new(Diffusion::new(derivative)),
        (scene::DensityMobility::Diffusion, Some(weight)) => {
            let points = WeightedDiffusion::flux_points(grid, derivative);
            let values = positive_values(&density.name, weight, &points)?;
            Box::new(WeightedDiffusion::new(grid, derivative, values))
        }
        (scene::DensityMobility::Exchange, _) => Box::new(Exchange),
        (scene::DensityMobility::Carried, _) => Box::new(Carried),
    })
}

fn positive_values(density: &str, weight: &Formula, points: &[f64]) -> Result<Vec<f64>, SetupError> {
    let program = Program::compile(&[weight.expression()]);
    let (mut values, mut scratch) = (vec![0.0; points.len()], vec![0.0; program.scratch_len()]);
    program.evaluate(&[points], &mut [&mut values], &mut scratch);
    match values.iter().position(|value| !(*value > 0.0 && value.is_finite())) {
        None => Ok(values),
        Some(at) => Err(SetupError::WeightNotPositive {
            density: density.to_owned(),
            parameter: points[at],
            value: values[at],
        }),
    }
}
