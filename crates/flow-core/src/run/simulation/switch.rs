//! Goes on in another gauge.

use std::time::Instant;

use super::Simulation;
use super::discretised::Discretised;
use crate::integrator::{Finish, Integrals, Multistep, Problem, Stepper};
use crate::run::adaptation::Adaptation;
use crate::run::failure::Failure;
use crate::run::gauges::Switched;
use crate::run::mesh::Mesh;

impl Simulation {
    /// Goes on in the next gauge from the state at hand.
    pub(super) fn switch(&mut self, time: f64, energy_before: f64) {
        let clock = Instant::now();
        let state = self.integration.stepper().state();
        let Some(switched) = self.gauges.switch(&mut self.on.membrane, state) else { return };
        let Switched { mut membrane, diagnostics, regraded } = match switched {
            Ok(switched) => switched,
            Err(error) => return self.fail(Failure::Gauge { time, error }),
        };
        let mut state = regraded.state;
        let finish = membrane.finish(time, &mut state);
        let Finish::Good { energy, integral_rates, .. } = finish else {
            return self.fail(Failure::NotFiniteInGauge { time }); // with the last state in the old gauge
        };
        self.start.remap_error += energy - energy_before;
        let mut counters = *self.integration.counters();
        counters.remaps += 1;
        self.switches += 1;
        self.adaptation = Adaptation::of(self.gauges.scene());
        let integrals = Integrals::new(time, self.integration.integrals(), integral_rates);
        let stepper = Multistep::starting(&mut membrane, &state, integrals, self.tolerance, &mut counters);
        let mesh = Mesh::of(membrane.layout().nodes());
        self.on = Discretised::new((membrane, diagnostics), mesh, counters.steps);
        self.go_on_by(stepper, energy, counters);
        let seconds = clock.elapsed().as_secs_f64();
        self.record.counters.integration_seconds += seconds;
        self.clocks.remaps += seconds;
    }
}
