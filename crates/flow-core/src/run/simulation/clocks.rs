//! The clocks of a run, and what they say of it.

use std::time::Instant;

use crate::flow::{EvaluationCost, PartCosts};
use crate::integrator::{Activity, Stopwatch};
use crate::run::seconds::{EvaluationSeconds, Seconds, Spending};

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
        self.remaps + self.frames + self.observers
    }

    /// The seconds of the run, of which one evaluation takes `costs`.
    pub fn seconds(&self, costs: &PartCosts) -> Seconds {
        let clocked: f64 = Activity::ALL.iter().map(|activity| self.watch.seconds(*activity)).sum();
        // The clocked steps stand for all of them; without any, all is left to the control of the steps.
        let scale = if clocked > 0.0 { self.integration / clocked } else { 0.0 };
        let of = |spending| match spending {
            Spending::Start => self.start,
            Spending::Step(Activity::StepControl) if clocked <= 0.0 => self.integration,
            Spending::Step(activity) => scale * self.watch.seconds(activity),
            Spending::Remaps => self.remaps,
            Spending::Frames => self.frames,
            Spending::Observers => self.observers,
            Spending::Output => 0.0,
        };
        let mut seconds = Seconds::new(of, EvaluationSeconds::default());
        seconds.evaluations = self.evaluations(costs, &seconds);
        seconds
    }

    /// The parts of the evaluations.
    fn evaluations(&self, costs: &PartCosts, seconds: &Seconds) -> EvaluationSeconds {
        let calls = |activity| self.watch.calls(activity) as f64;
        let beside_checks = |cost: &EvaluationCost| {
            calls(Activity::RightHandSide) * cost.rate
                + calls(Activity::Linearisation) * cost.linearisation
                + calls(Activity::JacobianProduct) * cost.product
        };
        let replayed = |cost: &EvaluationCost| beside_checks(cost) + calls(Activity::Check) * cost.check;
        // The run may have been slower than the replay. A check does more than the replay of its evaluation tells.
        let total = seconds.in_evaluations();
        let measured = total - seconds[Spending::Step(Activity::Check)];
        let slower = (measured / beside_checks(&costs.whole)).max(0.0); // 0 if there was no evaluation
        let parts = costs.terms.iter().chain([&costs.normal_mobility, &costs.density_mobilities]);
        let sum: f64 = parts.map(|cost| slower * replayed(cost)).sum();
        // Parts are never more than the whole.
        let scale = if sum > total { slower * total / sum } else { slower };
        EvaluationSeconds {
            terms: costs.terms.iter().map(|cost| scale * replayed(cost)).collect(),
            normal_mobility: scale * replayed(&costs.normal_mobility),
            density_mobilities: scale * replayed(&costs.density_mobilities),
            flow_map: (total - sum).max(0.0),
        }
    }
}
