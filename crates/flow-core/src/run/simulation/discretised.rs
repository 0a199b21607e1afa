//! What a run is replaced by as a whole where it takes other nodes or another gauge.

use super::Simulation;
use crate::integrator::{Adaptive, AdaptiveOptions, Counters, Multistep, Problem};
use crate::run::diagnostics::Diagnostics;
use crate::run::membrane::Membrane;
use crate::run::mesh::Mesh;

/// The membrane on the nodes in use, with all that is made for them.
#[derive(Debug)]
pub(super) struct Discretised {
    pub membrane: Membrane,
    pub diagnostics: Diagnostics,
    pub mesh: Mesh,
    /// Accepted steps when the nodes were chosen.
    pub remapped_at: u64,
    /// Room for a state.
    pub scratch: Vec<f64>,
}

impl Discretised {
    /// On the nodes of `mesh`, which were chosen after so many accepted steps.
    pub fn new((membrane, diagnostics): (Membrane, Diagnostics), mesh: Mesh, remapped_at: u64) -> Self {
        let scratch = vec![0.0; membrane.size()];
        Self { membrane, diagnostics, mesh, remapped_at, scratch }
    }
}

impl Simulation {
    /// Lets `stepper`, which stands at a state of this energy on the nodes in use, take the steps.
    pub(super) fn go_on_by(&mut self, stepper: Multistep, energy: f64, counters: Counters) {
        let options = AdaptiveOptions { end: self.next_stop(), ..*self.integration.options() };
        let scale = self.integration.energy_scale();
        self.integration = Adaptive::new(stepper, options, energy, counters).measured_by(scale);
    }
}
