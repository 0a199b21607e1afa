//! Who watches a run: observers read, never steer; they may ask it to stop.

use std::ops::ControlFlow;

/// Where a run stands after an accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Simulated time.
    pub time: f64,
    /// Simulated time at which the run ends at the latest.
    pub end: f64,
    /// Accepted steps so far.
    pub steps: u64,
    /// Size of the last step.
    pub step_size: f64,
    /// Energy after the step.
    pub energy: f64,
    /// Dissipation −d𝓕/dt ≥ 0 after the step.
    pub dissipation: f64,
    /// Length of the curve after the step.
    pub length: f64,
}

/// Watches a run, by the numbers of its [`Progress`]; the state itself it does not see. To stop by the state, take the steps with
/// [`Simulation::step`](super::Simulation::step) and look at [`Simulation::frame`](super::Simulation::frame), which costs about an
/// evaluation, or [`Simulation::state`](super::Simulation::state).
pub trait Observer {
    /// Called after every accepted step; `Break` stops the run, which keeps what it has.
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()>;

    /// Whether that may take a time to speak of, which a run then clocks for its record.
    fn takes_time(&self) -> bool {
        true
    }
}

/// An observer that watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Observer for Quiet {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn takes_time(&self) -> bool {
        false
    }
}
