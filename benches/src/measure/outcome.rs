//! One run: the step loop under a clock, and what it leaves.

use flow_core::integrator::{Adaptive, AdaptiveOptions, Counters, Problem, Stepper};

use super::clock::Clock;

/// Why a run did not reach its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfinished {
    /// The time limit of the measurement.
    TimeLimit,
    /// The step loop gave up.
    Failed,
}

/// What a run leaves.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Seconds of integration, of processor time where the system tells it.
    pub seconds: f64,
    /// Work.
    pub counters: Counters,
    /// The state at the end.
    pub state: Vec<f64>,
    /// Simulated time reached.
    pub time: f64,
    /// Why the end was not reached.
    pub unfinished: Option<Unfinished>,
}

/// Where a run starts and ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub(super) end: f64,
    pub(super) limit: f64,
    pub(super) energy: f64,
    pub(super) energy_tolerance: f64,
}

/// Runs the stepper that `build` makes, with its building under the clock.
pub(super) fn drive<S: Stepper>(
    problem: &mut dyn Problem,
    goal: Goal,
    build: impl FnOnce(&mut dyn Problem, &mut Counters) -> S,
) -> Outcome {
    let clock = Clock::start();
    let mut counters = Counters::default();
    let stepper = build(problem, &mut counters);
    let options = AdaptiveOptions {
        end: goal.end,
        most_steps: u64::MAX,
        energy_tolerance: goal.energy_tolerance,
        doubts_gradients: false,
    };
    let mut integration = Adaptive::new(stepper, options, goal.energy, counters);
    let mut unfinished = None;
    while integration.stepper().time() < goal.end && unfinished.is_none() {
        if integration.step(problem).is_err() {
            unfinished = Some(Unfinished::Failed);
        } else if clock.wall() > goal.limit && clock.seconds() > goal.limit {
            unfinished = Some(Unfinished::TimeLimit);
        }
    }
    Outcome {
        seconds: clock.seconds(),
        counters: *integration.counters(),
        state: integration.stepper().state().to_vec(),
        time: integration.stepper().time(),
        unfinished,
    }
}

impl Outcome {
    /// Relative L² difference of the curvature and relative difference of the length from `reference`.
    ///
    /// # Shapes
    /// Both states are spectral, on `nodes` nodes.
    #[must_use]
    pub fn errors(&self, reference: &[f64], nodes: usize) -> [f64; 2] {
        let length = self.state[self.state.len() - 1];
        let exact_length = reference[reference.len() - 1];
        let entries = 2 * (nodes / 2 + 1);
        let (mut difference, mut size) = (0.0, 0.0);
        for (entry, (turning, exact)) in self.state[..entries].iter().zip(reference).enumerate() {
            // The mean and the sawtooth stand once in the full spectrum, the others twice.
            let mode = entry / 2;
            let multiplicity = if mode == 0 || 2 * mode == nodes { 1.0 } else { 2.0 };
            difference += multiplicity * (turning / length - exact / exact_length).powi(2);
            size += multiplicity * (exact / exact_length).powi(2);
        }
        [(difference / size).sqrt(), (length / exact_length - 1.0).abs()]
    }
}
