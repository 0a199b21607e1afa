//! What a membrane must know to go on in another process.

use serde::{Deserialize, Serialize};

use super::super::invariants::KeptValues;
use super::Membrane;
use super::solver::Choice;
use crate::integrator::Problem;

/// What a membrane knows besides its state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MembraneMemory {
    solver: Choice,
    kept: KeptValues,
    start_angle: f64,
    placed: Placed,
    factorised: Factorised,
}

/// The mean tangent angle at the last accepted state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Placed {
    pub time: f64,
    pub angle: f64,
    pub angle_rate: f64,
}

/// The spectral state of a factorisation, with its γ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Factorised {
    pub state: Vec<f64>,
    pub gamma: f64,
}

impl Membrane {
    /// What it takes to go on from here.
    #[must_use]
    pub fn memory(&self) -> MembraneMemory {
        MembraneMemory {
            solver: self.solver.choice(),
            kept: self.invariants.kept_values(),
            start_angle: self.start_angle,
            placed: self.placed,
            factorised: self.factorised.clone(),
        }
    }

    /// Goes on from `memory`, with the factorisation that it speaks of if that is `needed`; false if it does not fit.
    pub fn resume(&mut self, memory: MembraneMemory, needed: bool) -> bool {
        let Factorised { state, gamma } = memory.factorised;
        if state.len() != self.flow.spectral_layout().len() || !self.invariants.set_kept_values(memory.kept) {
            return false;
        }
        self.solver.choose(memory.solver);
        self.start_angle = memory.start_angle;
        self.placed = memory.placed;
        if !needed {
            return true;
        }
        let mut rate = vec![0.0; state.len()];
        self.linearise(&state, &mut rate);
        self.factorise(gamma)
    }
}
