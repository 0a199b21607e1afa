//! What a simulation must know to go on, in another process, as if it had never stopped.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::Simulation;
use super::clocks::Clocks;
use super::discretised::Discretised;
use super::frame::Start;
use super::saving::FrameRoom;
use crate::energies::EnergyTerm;
use crate::integrator::{self, Counters, IntegrationError, Multistep, Problem, Rest, Stepper, Stopwatch};
use crate::run::adaptation::Adaptation;
use crate::run::equilibrium::Equilibrium;
use crate::run::failure::Failure;
use crate::run::membrane::MembraneMemory;
use crate::run::mesh::Mesh;
use crate::run::own_terms::OwnTerms;
use crate::run::record::{Frame, StepLog, StopReason};
use crate::run::scene::Scene;
use crate::run::setup_error::SetupError;

/// The state of a simulation without its frames and its log of steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    integration: integrator::Memory,
    energy: f64,
    rest: Rest,
    counters: Counters,
    membrane: MembraneMemory,
    start: Start,
    scheduled_frames: usize,
    closure_defect: f64,
    allowed_crossings: Option<usize>,
    equilibrium: Option<Equilibrium>,
    mesh: Mesh,
    remapped_at: u64,
    switches: u64,
    /// Why it is over; none if there is more to do.
    stopped: Option<StopReason>,
}

impl Memory {
    /// Accepted steps so far.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.counters.steps
    }

    /// Time of the last accepted state.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.integration.points.first().map_or(0.0, |(time, _)| *time)
    }

    /// Frames of the schedule so far, the initial one included.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.scheduled_frames
    }
}

/// Why a simulation cannot go on from a memory.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResumeError {
    /// The scene makes no initial state.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Terms from outside the scene are missing.
    #[error(
        "the run has {saved} energy terms and its scene makes {known} of them: the others are from outside, and only the program that \
         has them can go on, by `Simulation::resume_with_terms` or `Checkpoint::simulation_with_terms`"
    )]
    TermsMissing {
        /// Terms of the run.
        saved: usize,
        /// Terms here.
        known: usize,
    },
    /// The numbers do not belong to the scene.
    #[error(
        "the checkpoint does not fit its scene: {item}; it was written by another version, or is damaged: run the scene \
         anew"
    )]
    Foreign {
        /// What does not fit.
        item: &'static str,
    },
}

/// Whether times are finite and increase.
fn is_sequence(times: impl Iterator<Item = f64> + Clone) -> bool {
    times.clone().all(f64::is_finite)
        && times.clone().zip(times.skip(1)).all(|(before, after)| before < after)
}

impl Simulation {
    /// What it takes to go on from the last accepted state. A run that was interrupted, or has used up its steps, goes on from
    /// there; one that is over stays so.
    #[must_use]
    pub fn memory(&self) -> Memory {
        Memory {
            integration: self.integration.stepper().memory(),
            energy: self.integration.energy(),
            rest: self.integration.rest(),
            counters: self.counters_with_time(),
            membrane: self.on.membrane.memory(),
            start: self.start,
            scheduled_frames: self.scheduled_frames,
            closure_defect: self.closure_defect,
            allowed_crossings: self.allowed_crossings,
            equilibrium: self.equilibrium.clone(),
            mesh: self.on.mesh.clone(),
            remapped_at: self.on.remapped_at,
            switches: self.switches,
            stopped: self.stopped.clone().filter(|_| !self.can_go_on()),
        }
    }

    /// The scene as given and as resolved.
    #[must_use]
    pub fn scene_texts(&self) -> (&str, &str) {
        (&self.record.scene, &self.record.resolved_scene)
    }

    /// Why it stopped, if it has.
    #[must_use]
    pub fn stop_reason(&self) -> Option<&StopReason> {
        self.stopped.as_ref()
    }

    /// Whether one that has stopped goes on if it is resumed: it was interrupted, or has used up `time.max_steps`, of which a resumed
    /// run may have more.
    #[must_use]
    pub fn can_go_on(&self) -> bool {
        let used_up =
            |failure| matches!(failure, &Failure::Integration(IntegrationError::TooManySteps { .. }));
        self.stopped == Some(StopReason::Interrupted) || self.failure.as_ref().is_some_and(used_up)
    }

    /// Why it failed, if it did.
    #[must_use]
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// Log of the steps so far.
    #[must_use]
    pub fn steps(&self) -> &StepLog {
        &self.record.steps
    }

    /// The simulation of `scene` that left `memory`, `frames` and `steps` behind. Its further states are those of the
    /// unbroken run, bit for bit, on the same machine and with the same version of the program.
    ///
    /// # Errors
    /// [`ResumeError`] if they do not belong to the scene.
    pub fn resume(
        scene: &Scene,
        memory: Memory,
        frames: Vec<Frame>,
        steps: StepLog,
    ) -> Result<Self, ResumeError> {
        Self::resume_with(scene, OwnTerms::default(), memory, frames, steps)
    }

    /// The same for a simulation that was made by [`Simulation::with_terms`]: `terms` makes the same terms.
    ///
    /// # Errors
    /// [`ResumeError`] if they do not belong to the scene with these terms.
    pub fn resume_with_terms(
        scene: &Scene,
        terms: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static,
        memory: Memory,
        frames: Vec<Frame>,
        steps: StepLog,
    ) -> Result<Self, ResumeError> {
        Self::resume_with(scene, OwnTerms::made_by(terms), memory, frames, steps)
    }

    fn resume_with(
        scene: &Scene,
        own: OwnTerms,
        memory: Memory,
        mut frames: Vec<Frame>,
        steps: StepLog,
    ) -> Result<Self, ResumeError> {
        let foreign = |item| ResumeError::Foreign { item };
        let clock = Instant::now();
        let mut simulation = Self::with(scene, own)?;
        let (saved, known) = (frames.first(), simulation.record.energy_terms.len());
        let saved = saved.map_or(known, |frame| frame.energy_terms.len());
        if saved > known {
            return Err(ResumeError::TermsMissing { saved, known });
        }
        let turning_number = simulation.on.membrane.turning_number();
        simulation.gauges.skip(memory.switches.saturating_sub(simulation.switches)); // one may be at the start
        simulation.adaptation = Adaptation::of(simulation.gauges.scene());
        if !memory.mesh.is_possible() {
            return Err(foreign("the number of nodes"));
        }
        if memory.counters.remaps > 0 {
            let built = simulation.gauges.build(&memory.mesh, turning_number)?;
            simulation.on = Discretised::new(built, memory.mesh, memory.remapped_at);
        }
        if !memory.integration.fits(simulation.on.membrane.size()) {
            return Err(foreign("the past states"));
        }
        let needed = memory.integration.factorisation.gamma.is_some();
        if !simulation.on.membrane.resume(memory.membrane, needed) {
            return Err(foreign("the state of the linear solver"));
        }
        if memory.scheduled_frames == 0 || frames.len() < memory.scheduled_frames {
            return Err(foreign("the frames"));
        }
        frames.truncate(memory.scheduled_frames);
        let first = simulation.record.frames.first();
        if !frames.iter().all(|frame| first.is_some_and(|first| frame.is_shaped_like(first))) {
            return Err(foreign("the number of values of the frames"));
        }
        if !is_sequence(frames.iter().map(|frame| frame.time)) {
            return Err(foreign("the times of the frames"));
        }
        let lengths = steps.lengths();
        if lengths.iter().any(|length| *length as u64 != memory.counters.steps) {
            return Err(foreign("the log of steps"));
        }
        let stepper = Multistep::resume(&simulation.on.membrane, memory.integration, simulation.tolerance);
        if stepper.time() > simulation.end {
            return Err(foreign("the time"));
        }
        simulation.go_on_by(stepper, memory.energy, memory.counters);
        simulation.integration.watch_on(memory.rest);
        simulation.record.counters = memory.counters;
        let nodes = frames.iter().map(Frame::nodes).max();
        simulation.frame_room = FrameRoom::new(nodes.unwrap_or_default());
        simulation.record.frames = frames;
        simulation.record.steps = steps;
        simulation.start = memory.start;
        simulation.scheduled_frames = memory.scheduled_frames;
        simulation.closure_defect = memory.closure_defect;
        simulation.allowed_crossings = memory.allowed_crossings;
        simulation.equilibrium = memory.equilibrium;
        simulation.switches = memory.switches;
        simulation.clocks = Clocks::started(clock, 0.0, Stopwatch::default());
        if let Some(reason) = memory.stopped {
            simulation.stop(reason);
        }
        Ok(simulation)
    }
}
