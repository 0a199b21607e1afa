//! The gauge in force, the changes to come, and the membrane on the nodes that a run goes on with.

use std::collections::VecDeque;
use std::sync::Arc;

use super::assembly;
use super::choices::linear_solver;
use super::diagnostics::Diagnostics;
use super::energy_terms::Initial;
use super::membrane::Membrane;
use super::mesh::Mesh;
use super::scene::Scene;
use super::setup_error::SetupError;
use crate::flow::{Regraded, regrade};
use crate::geometry::Grading;

/// The scene with the gauge in force, and with those to come.
#[derive(Debug)]
pub struct Gauges {
    initial: Initial,
    scene: Scene,
    pending: VecDeque<(f64, Scene)>,
}

/// A run on other nodes.
#[derive(Debug)]
pub(super) struct Switched {
    pub membrane: Membrane,
    pub diagnostics: Diagnostics,
    pub regraded: Regraded,
}

impl Gauges {
    /// Those of `scene`, which starts on `mesh`.
    ///
    /// # Errors
    /// [`SetupError::Grading`] if a grading is not positive, or not resolved.
    pub(super) fn new(scene: &Scene, initial: &Initial, mesh: &Mesh) -> Result<Self, SetupError> {
        let mut pending = VecDeque::new();
        for switch in &scene.flow.switch {
            let mut scene = scene.clone();
            scene.flow.gauge = switch.gauge;
            scene.flow.grading.clone_from(&switch.grading);
            Mesh::of(mesh.nodes).grading(&scene)?;
            pending.push_back((switch.time, scene));
        }
        Ok(Self { initial: initial.clone(), scene: scene.clone(), pending })
    }

    /// Time of the next change; the end of time if none is left.
    pub(super) fn next_time(&self) -> f64 {
        self.pending.front().map_or(f64::INFINITY, |(time, _)| *time)
    }

    /// The scene with the gauge in force.
    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Puts the next change into effect on the spectral `state` of `membrane`, on as many nodes; none if none is left.
    ///
    /// # Errors
    /// [`SetupError`] if the state cannot be had on the other nodes.
    pub(super) fn switch(
        &mut self,
        membrane: &mut Membrane,
        state: &[f64],
    ) -> Option<Result<Switched, SetupError>> {
        self.scene = self.pending.pop_front()?.1;
        Some(self.regraded(membrane, state))
    }

    fn regraded(&self, before: &mut Membrane, state: &[f64]) -> Result<Switched, SetupError> {
        let turning_number = before.turning_number();
        let mesh = Mesh::of(before.layout().nodes());
        let (mut membrane, diagnostics) = self.build(&mesh, turning_number)?;
        let regraded = regrade(before.flow(), membrane.flow(), state, turning_number)?;
        membrane.follow(before);
        Ok(Switched { membrane, diagnostics, regraded })
    }

    /// The membrane on the nodes of `mesh` in the gauge in force.
    ///
    /// # Errors
    /// [`SetupError::Grading`] if the grading is not resolved by so many nodes.
    pub(super) fn build(
        &self,
        mesh: &Mesh,
        turning_number: i32,
    ) -> Result<(Membrane, Diagnostics), SetupError> {
        self.build_on(mesh.nodes, mesh.grading(&self.scene)?, turning_number)
    }

    /// The same with the grading known.
    ///
    /// # Errors
    /// [`SetupError`] if a weight of a density is not positive on the nodes.
    pub(super) fn build_on(
        &self,
        nodes: usize,
        grading: Option<Arc<Grading>>,
        turning_number: i32,
    ) -> Result<(Membrane, Diagnostics), SetupError> {
        let (mut flow, diagnostics) = assembly::flow(&self.scene, &self.initial, nodes, grading)?;
        flow.set_kept_area(self.initial.area);
        let solver = linear_solver(self.scene.accuracy.linear_solver);
        Ok((Membrane::new(flow, solver, turning_number, 0.0), diagnostics))
    }

    /// Passes over the first `count` changes, into the gauge of the last of them.
    pub(super) fn skip(&mut self, count: u64) {
        for _ in 0..count {
            if let Some((_, scene)) = self.pending.pop_front() {
                self.scene = scene;
            }
        }
    }
}
