//! The clocks of a run, and what they say of it.

use std::time::Instant;

use crate::flow::{EvaluationCost, PartCosts};
use crate::integrator::{Activity, Stopwatch};
use crate::run::seconds::{EvaluationSeconds, Seconds};

/// Time by what it was spent on, in seconds.
#[derive(Clone, Debug, Default)]
pub(super) struct Clocks {
    pub start: f64,
    /// The steps, from their first to their last line.
    pub integration: f64,
    /// How the steps divide.
    pub watch: Stopwatch,
    pub remaps: f64,
    pub frames: f64,
    pub observers: f64,
}

impl Clocks {
    /// Clocks that have seen a start of so many seconds, with so many seconds of integration in it.
    pub fn started(clock: Instant, integration: f64, watch: Stopwatch) -> Self {
        let start = clock.elapsed().as_secs_f64() - integration;
        Self { start, integration, watch, ..Self::default() }
    }

    /// What happens after a step but has a clock of its own.
    pub fn aside(&self) -> f64 {
        self.remaps + self.frames
    }

    /// The seconds of the run, of which one evaluation takes `costs`.
    pub fn seconds(&self, costs: &PartCosts) -> Seconds {
        let clocked: f64 = Activity::ALL.iter().map(|activity| self.watch.seconds(*activity)).sum();
        // The clocked steps stand for all of them; without any, all is left to the control of the steps.
        let scale = if clocked > 0.0 { self.integration / clocked } else { 0.0 };
        let of = |activity| scale * self.watch.seconds(activity);
        let mut seconds = Seconds {
            start: self.start,
            right_hand_sides: of(Activity::RightHandSide),
            linearisations: of(Activity::Linearisation),
            jacobian_products: of(Activity::JacobianProduct),
            factorisations: of(Activity::Factorisation),
            solves: of(Activity::Solve),
            krylov: of(Activity::Krylov),
            checks: of(Activity::Check),
            step_control: if clocked > 0.0 { of(Activity::StepControl) } else { self.integration },
            remaps: self.remaps,
            frames: self.frames,
            observers: self.observers,
            output: 0.0,
            evaluations: EvaluationSeconds::default(),
        };
        seconds.evaluations = self.evaluations(costs, seconds.in_evaluations());
        seconds
    }

    /// The parts of the evaluations, which took `total` seconds.
    fn evaluations(&self, costs: &PartCosts, total: f64) -> EvaluationSeconds {
        let calls = |activity| self.watch.calls(activity) as f64;
        let seconds = |cost: &EvaluationCost| {
            calls(Activity::RightHandSide) * cost.rate
                + calls(Activity::Check) * cost.check
                + calls(Activity::Linearisation) * cost.linearisation
                + calls(Activity::JacobianProduct) * cost.product
        };
        let parts = costs.terms.iter().chain([&costs.normal_mobility, &costs.density_mobilities]);
        let sum: f64 = parts.map(seconds).sum();
        // The machine may be slower during the replay than during the run: parts are never more than the whole.
        let scale = if sum > total { total / sum } else { 1.0 };
        EvaluationSeconds {
            terms: costs.terms.iter().map(|cost| scale * seconds(cost)).collect(),
            normal_mobility: scale * seconds(&costs.normal_mobility),
            density_mobilities: scale * seconds(&costs.density_mobilities),
            flow_map: (total - sum).max(0.0),
        }
    }
}
