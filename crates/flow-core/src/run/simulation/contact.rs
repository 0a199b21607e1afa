//! When within a step the curve comes into contact with itself, and the end of a run there.

use super::Simulation;
use super::discretised::Discretised;
use crate::integrator::{Finish, Multistep, Problem, StepReport, Stepper};

/// Part of the tolerance to which the time of a contact is found, in units of the step.
const SHARE: f64 = 0.1;
/// States that are looked at to find it at most, for the tightest tolerances.
const MOST_LOOKS: u32 = 30;

impl Simulation {
    /// The last time within the step just taken at which the curve does not cross itself more often than it may, if it does at its end:
    /// by bisection, on the states that frames would show. Where it does so from the start of the step on, a time just after that.
    pub(super) fn contact(&mut self, step: &StepReport) -> Option<f64> {
        let allowed = self.allowed_crossings?;
        if self.on.membrane.crossings(self.integration.stepper().state()) <= allowed {
            return None;
        }
        let start = self.start_of_step();
        let precision = SHARE * self.tolerance * (step.time - start);
        let (mut free, mut crossed) = (start, step.time);
        for _ in 0..MOST_LOOKS {
            let middle = 0.5 * (free + crossed);
            let found = free > start && crossed - free <= precision;
            if found || middle <= free || middle >= crossed {
                break;
            }
            if self.crosses(middle, allowed) {
                crossed = middle;
            } else {
                free = middle;
            }
        }
        Some(if free > start { free } else { crossed })
    }

    /// Whether the curve crosses itself more than `allowed` times at `time` within the last step.
    fn crosses(&mut self, time: f64, allowed: usize) -> bool {
        let Discretised { membrane, scratch, .. } = &mut self.on;
        self.integration.stepper().interpolate(time, scratch);
        matches!(membrane.finish(time, scratch), Finish::NotFinite) || membrane.crossings(scratch) > allowed
    }

    /// Takes back what the last step, `step`, did after `time`, for a run that is over there; returns the rest of the step.
    pub(super) fn end_step_at(&mut self, time: f64, step: &StepReport) -> StepReport {
        let start = self.start_of_step();
        let integrals = self.integration.stepper().interpolate(time, &mut self.on.scratch);
        let frame = self.on.frame(time, integrals, &self.start, None); // closes the state
        let memory = self.integration.stepper().memory().ended_at(time, &self.on.scratch, integrals);
        let stepper = Multistep::resume(&self.on.membrane, memory, self.tolerance);
        self.go_on_by(stepper, frame.energy, *self.integration.counters());
        self.closure_defect = frame.closure_defect;
        StepReport {
            time,
            size: time - start,
            energy: frame.energy,
            lost: step.lost + (step.energy - frame.energy),
            dissipation: frame.dissipation,
            settled_dissipation: frame.dissipation,
            ..*step
        }
    }

    /// Time at the start of the last step, which is not in the log yet.
    fn start_of_step(&self) -> f64 {
        self.record.steps.time.last().copied().unwrap_or(0.0)
    }
}
