//! Goes on in another gauge.

use std::time::Instant;

use super::Simulation;
use crate::integrator::{Adaptive, AdaptiveOptions, Bdf, Finish, Integrals, Problem, StepReport, Stepper};
use crate::run::record::StopReason;
use crate::run::switches::Switched;

impl Simulation {
    /// Goes on in the next gauge from the state at hand.
    pub(super) fn switch(&mut self, report: &StepReport) {
        let clock = Instant::now();
        let state = self.integration.stepper().state();
        let Some(switched) = self.switches.apply(&mut self.membrane, state) else { return };
        let Switched { membrane, diagnostics, regraded } = match switched {
            Ok(switched) => switched,
            Err(error) => {
                return self.stop(StopReason::Failed(format!("at t = {:.6e}: {error}", report.time)));
            }
        };
        (self.membrane, self.diagnostics) = (membrane, diagnostics);
        self.scratch = regraded.state;
        let finish = self.membrane.finish(report.time, &mut self.scratch);
        let Finish::Good { energy, integral_rates, .. } = finish else {
            let message = format!("at t = {:.6e}: the state is not finite in the next gauge", report.time);
            return self.stop(StopReason::Failed(message));
        };
        self.start.remap_error += energy - report.energy;
        let mut counters = *self.integration.counters();
        counters.remaps += 1;
        let integrals = Integrals::new(report.time, self.integration.integrals(), integral_rates);
        let stepper =
            Bdf::starting(&mut self.membrane, &self.scratch, integrals, self.tolerance, &mut counters);
        let options = AdaptiveOptions { end: self.next_stop(), ..*self.integration.options() };
        self.integration = Adaptive::new(stepper, options, energy, counters);
        let seconds = clock.elapsed().as_secs_f64();
        self.record.counters.integration_seconds += seconds;
        self.clocks.remaps += seconds;
    }
}
