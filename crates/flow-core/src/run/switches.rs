//! Carries out the changes of the gauge that a scene names.

use std::collections::VecDeque;
use std::sync::Arc;

use super::diagnostics::Diagnostics;
use super::energy_terms::Initial;
use super::grading::grading;
use super::membrane::Membrane;
use super::scene::Scene;
use super::setup;
use super::setup_error::SetupError;
use crate::flow::{Regraded, regrade};
use crate::geometry::Grading;

/// The changes to come.
#[derive(Debug)]
pub struct Switches {
    initial: Initial,
    nodes: usize,
    pending: VecDeque<Pending>,
}

/// The scene as it is from `time` on.
#[derive(Debug)]
struct Pending {
    time: f64,
    scene: Scene,
    grading: Option<Arc<Grading>>,
}

/// A run on other nodes.
#[derive(Debug)]
pub(super) struct Switched {
    pub membrane: Membrane,
    pub diagnostics: Diagnostics,
    pub regraded: Regraded,
}

impl Switches {
    /// Those of `scene` on `nodes` nodes.
    ///
    /// # Errors
    /// [`SetupError::Grading`] if a grading is not positive, or not resolved.
    pub(super) fn new(scene: &Scene, initial: Initial, nodes: usize) -> Result<Self, SetupError> {
        let mut pending = VecDeque::new();
        for switch in &scene.flow.switch {
            let mut scene = scene.clone();
            scene.flow.gauge = switch.gauge;
            scene.flow.grading.clone_from(&switch.grading);
            let grading = grading(&scene, nodes)?;
            pending.push_back(Pending { time: switch.time, scene, grading });
        }
        Ok(Self { initial, nodes, pending })
    }

    /// Time of the next change; the end of time if none is left.
    pub(super) fn next_time(&self) -> f64 {
        self.pending.front().map_or(f64::INFINITY, |next| next.time)
    }

    /// Puts the next change into effect on the spectral `state` of `membrane`; none if none is left.
    ///
    /// # Errors
    /// [`SetupError`] if the state cannot be had on the other nodes.
    pub(super) fn apply(
        &mut self,
        membrane: &mut Membrane,
        state: &[f64],
    ) -> Option<Result<Switched, SetupError>> {
        let next = self.pending.pop_front()?;
        Some(self.remap(&next, membrane, state))
    }

    fn remap(&self, next: &Pending, before: &mut Membrane, state: &[f64]) -> Result<Switched, SetupError> {
        let turning_number = before.turning_number();
        let (mut membrane, diagnostics) = self.build(next, turning_number)?;
        let regraded = regrade(before.flow(), membrane.flow(), state, turning_number)?;
        membrane.follow(before);
        Ok(Switched { membrane, diagnostics, regraded })
    }

    fn build(&self, next: &Pending, turning_number: i32) -> Result<(Membrane, Diagnostics), SetupError> {
        let scene = &next.scene;
        let (flow, diagnostics) = setup::flow(scene, self.initial, self.nodes, next.grading.clone())?;
        let solver = setup::linear_solver(scene.accuracy.linear_solver);
        Ok((Membrane::new(flow, solver, turning_number, 0.0), diagnostics))
    }

    /// Passes over the first `count` changes, into the gauge of the last of them; none if there are none.
    ///
    /// # Errors
    /// [`SetupError`] as for [`Switches::apply`].
    pub(super) fn skip(
        &mut self,
        count: u64,
        turning_number: i32,
    ) -> Option<Result<(Membrane, Diagnostics), SetupError>> {
        let last = (0..count).filter_map(|_| self.pending.pop_front()).last()?;
        Some(self.build(&last, turning_number))
    }
}
