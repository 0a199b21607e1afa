//! The automatic number of nodes: enough for the initial curve and for the fronts that a scene names.

use super::grading::{grading, resample};
use super::scene::{Length, LengthTarget, Nodes, Scene};
use super::setup_error::SetupError;
use crate::geometry::shapes::Shape;
use crate::geometry::{Embedding, GradingError};

/// Fewest nodes that the automatic choice takes.
const FEWEST: usize = 128;
/// Most nodes.
pub const MOST: usize = 65536;
/// Largest distance of nodes in units of ε: a front of width ε/√2 then spans about eight of them from
/// one side to the other.
const NODE_DISTANCE_PER_EPSILON: f64 = 0.55;
/// Gap of the sampled initial curve, relative to its length and to the tolerance.
const GAP_PER_TOLERANCE: f64 = 1.0;

/// The number of nodes of a scene.
///
/// # Errors
/// [`SetupError`] if the curve is unusable or needs too many nodes.
pub fn nodes(scene: &Scene, shape: &Shape, initial_length: f64) -> Result<usize, SetupError> {
    match scene.accuracy.nodes {
        Nodes::Count(nodes) => Ok(nodes),
        Nodes::Auto => {
            let for_fronts = fast_size(fronts(scene, initial_length))?;
            let mut nodes = for_fronts.max(FEWEST);
            while gap(scene, shape, nodes)? > GAP_PER_TOLERANCE * scene.accuracy.tolerance {
                nodes = fast_size(1.3 * nodes as f64)?;
            }
            Ok(nodes)
        }
    }
}

/// Nodes that the fronts of the agents need on the longest curve expected.
fn fronts(scene: &Scene, initial_length: f64) -> f64 {
    let target = match &scene.energy.length {
        Some(Length::Penalty { target: LengthTarget::Absolute(target), .. }) => *target,
        Some(Length::Penalty { target: LengthTarget::Ratio(ratio), .. }) => ratio * initial_length,
        _ => initial_length,
    };
    scene.energy.agents.as_ref().map_or(0.0, |agents| {
        target.max(initial_length) / (NODE_DISTANCE_PER_EPSILON * agents.epsilon.min(agents.delta))
    })
}

/// Gap of the curve sampled at `nodes` nodes, relative to its length.
fn gap(scene: &Scene, shape: &Shape, nodes: usize) -> Result<f64, SetupError> {
    let grading = match grading(scene, nodes) {
        Err(SetupError::Grading(GradingError::NotResolved { .. })) => return Ok(f64::INFINITY),
        other => other?,
    };
    let curve = resample(shape, nodes, grading.as_deref())?;
    let mut turning: Vec<f64> = curve.curvature.iter().map(|kappa| kappa * curve.length).collect();
    if let Some(grading) = &grading {
        grading.weigh(&mut turning);
    }
    let mut embedding = Embedding::graded(nodes, grading);
    embedding.set_tangent(&turning, curve.length, curve.angle);
    let [x, y] = embedding.gap();
    Ok(x.hypot(y) / curve.length)
}

/// The least 2ᵃ3ᵇ, a ≥ 3, that is at least `least`: its transforms are fast.
fn fast_size(least: f64) -> Result<usize, SetupError> {
    let mut best = usize::MAX;
    let mut power_of_three = 8;
    while power_of_three <= 2 * MOST {
        let mut size = power_of_three;
        while (size as f64) < least && size <= 2 * MOST {
            size *= 2;
        }
        if size as f64 >= least {
            best = best.min(size);
        }
        power_of_three *= 3;
    }
    if best > MOST { Err(SetupError::TooManyNodes { needed: least, most: MOST }) } else { Ok(best) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_fast_and_large_enough() {
        for (least, size) in [(1.0, 8), (100.0, 128), (129.0, 144), (505.0, 512), (1300.0, 1536)] {
            assert_eq!(fast_size(least).unwrap(), size);
        }
        assert!(matches!(fast_size(1e7), Err(SetupError::TooManyNodes { .. })));
    }
}
