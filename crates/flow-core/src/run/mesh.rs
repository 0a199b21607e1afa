//! Where the nodes of a run lie on the curve.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::scene::{FEWEST_NODES, MOST_NODES, Scene};
use super::setup_error::SetupError;
use crate::flow::MetricRole;
use crate::geometry::Grading;

/// How many nodes there are, and their grading if the program has chosen it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Number of nodes.
    pub nodes: usize,
    /// Samples of the grading (see [`Grading::samples`]) that the program has chosen.
    pub samples: Option<Vec<f64>>,
}

impl Mesh {
    /// `nodes` nodes, graded as the scene says; uniform if it leaves that to the program.
    #[must_use]
    pub fn of(nodes: usize) -> Self {
        Self { nodes, samples: None }
    }

    /// Whether a run can have so many nodes; a mesh that was read may have any number.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        (FEWEST_NODES..=MOST_NODES).contains(&self.nodes)
    }

    /// The grading in the gauge of `scene`; none if the nodes are uniform.
    ///
    /// # Errors
    /// [`SetupError::Grading`] if it is not positive, or not resolved.
    pub fn grading(&self, scene: &Scene) -> Result<Option<Arc<Grading>>, SetupError> {
        let samples = match (&self.samples, &scene.flow.grading) {
            (Some(samples), _) => samples.clone(),
            (None, Some(formula)) => {
                let count = Grading::samples(self.nodes);
                formula.values(&(0..count).map(|i| i as f64 / count as f64).collect::<Vec<_>>())
            }
            // A metric that is a field starts as a uniform one, if nothing else is said.
            (None, None) if scene.flow.gauge.metric() == MetricRole::Field => {
                return Ok(Some(Arc::new(Grading::uniform(self.nodes))));
            }
            (None, None) => return Ok(None),
        };
        Ok(Some(Arc::new(Grading::new(&samples)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_that_no_run_has_are_not_possible() {
        let possible = [0, 1, 7, 8, 65_536, 65_537, usize::MAX].map(|nodes| Mesh::of(nodes).is_possible());
        assert_eq!(possible, [false, false, false, true, true, false, false]);
    }
}
