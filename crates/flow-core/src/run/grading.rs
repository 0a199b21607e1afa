//! The grading that a scene names, and its curve on the nodes.

use std::sync::Arc;

use super::scene::{Gauge, Scene};
use super::setup_error::SetupError;
use crate::geometry::Grading;
use crate::geometry::shapes::{Resampled, Shape};

/// The grading of a scene on `nodes` nodes; none if they are uniform.
///
/// # Errors
/// [`SetupError::Grading`] if it is not positive, or not resolved.
pub fn grading(scene: &Scene, nodes: usize) -> Result<Option<Arc<Grading>>, SetupError> {
    let count = Grading::samples(nodes);
    let Some(formula) = &scene.flow.grading else {
        // The metric of the co-moving gauge starts as a uniform one, if nothing else is said.
        let uniform = (scene.flow.gauge == Gauge::CoMoving).then(|| Grading::uniform(nodes));
        return Ok(uniform.map(Arc::new));
    };
    let points: Vec<f64> = (0..count).map(|i| i as f64 / count as f64).collect();
    Ok(Some(Arc::new(Grading::new(&formula.values(&points))?)))
}

/// `shape` at uniform or graded nodes.
///
/// # Errors
/// [`SetupError::Curve`] if the curve is not usable.
pub fn resample(shape: &Shape, nodes: usize, grading: Option<&Grading>) -> Result<Resampled, SetupError> {
    Ok(match grading {
        None => shape.resample(nodes)?,
        Some(grading) => shape.resample_graded(grading)?,
    })
}
