//! Where the wall time of a run went.

use std::ops::{Index, IndexMut};

use crate::integrator::Activity;

/// What the time of a run is spent on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spending {
    /// From the scene to the first frame.
    Start,
    /// What a step does.
    Step(Activity),
    /// Changes of the nodes or of the gauge.
    Remaps,
    /// Frames with all that they hold.
    Frames,
    /// Those who watch: progress and callbacks, contact, equilibrium, the log of steps.
    Observers,
    /// Checkpoints and the result file.
    Output,
}

impl Spending {
    /// All of them, in the order of the course of a run.
    pub const ALL: [Self; 13] = [
        Self::Start,
        Self::Step(Activity::RightHandSide),
        Self::Step(Activity::Linearisation),
        Self::Step(Activity::JacobianProduct),
        Self::Step(Activity::Factorisation),
        Self::Step(Activity::Solve),
        Self::Step(Activity::Krylov),
        Self::Step(Activity::Check),
        Self::Step(Activity::StepControl),
        Self::Remaps,
        Self::Frames,
        Self::Observers,
        Self::Output,
    ];

    /// The name in result files and in Python.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Step(Activity::RightHandSide) => "right_hand_sides",
            Self::Step(Activity::Linearisation) => "linearisations",
            Self::Step(Activity::JacobianProduct) => "jacobian_products",
            Self::Step(Activity::Factorisation) => "factorisations",
            Self::Step(Activity::Solve) => "solves",
            Self::Step(Activity::Krylov) => "krylov",
            Self::Step(Activity::Check) => "checks",
            Self::Step(Activity::StepControl) => "step_control",
            Self::Remaps => "remaps",
            Self::Frames => "frames",
            Self::Observers => "observers",
            Self::Output => "output",
        }
    }

    /// Index among [`Spending::ALL`].
    fn place(self) -> usize {
        let steps = Activity::ALL.len();
        match self {
            Self::Start => 0,
            Self::Step(activity) => 1 + activity as usize,
            Self::Remaps => steps + 1,
            Self::Frames => steps + 2,
            Self::Observers => steps + 3,
            Self::Output => steps + 4,
        }
    }
}

/// Seconds of wall time by what they were spent on, since the run was started or, if it was, resumed. They add up to the
/// time spent in the run; those of the integration are clocked in some steps and scaled to the time of all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seconds {
    spent: [f64; Spending::ALL.len()],
    /// Parts of the evaluations of the flow.
    pub evaluations: EvaluationSeconds,
}

impl Index<Spending> for Seconds {
    type Output = f64;

    fn index(&self, spending: Spending) -> &f64 {
        &self.spent[spending.place()]
    }
}

impl IndexMut<Spending> for Seconds {
    fn index_mut(&mut self, spending: Spending) -> &mut f64 {
        &mut self.spent[spending.place()]
    }
}

/// Seconds by part of the right-hand sides, linearisations, products and checks, which they add up to. The time of a part in
/// each of them is measured in a short replay on the final state, and multiplied by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EvaluationSeconds {
    /// Of each term of the energy, with the machinery that it alone needs, in the order of the names of the record.
    pub terms: Vec<f64>,
    /// The normal mobility.
    pub normal_mobility: f64,
    /// The mobilities of the densities.
    pub density_mobilities: f64,
    /// What every flow needs: gauge, flow map, transforms, closure.
    pub flow_map: f64,
}

impl Seconds {
    /// Those that `of` tells, and the parts of the evaluations.
    pub fn new(of: impl FnMut(Spending) -> f64, evaluations: EvaluationSeconds) -> Self {
        Self { spent: Spending::ALL.map(of), evaluations }
    }

    /// What they were spent on by name, in the order of the course of a run.
    #[must_use]
    pub fn by_activity(&self) -> [(&'static str, f64); Spending::ALL.len()] {
        Spending::ALL.map(|spending| (spending.name(), self[spending]))
    }

    /// Seconds of the whole run.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.spent.iter().sum()
    }

    /// Seconds of the integration: of all that steps take.
    #[must_use]
    pub fn in_steps(&self) -> f64 {
        let in_steps = Spending::ALL.iter().filter(|spending| matches!(spending, Spending::Step(_)));
        in_steps.map(|spending| self[*spending]).sum()
    }

    /// Seconds of all evaluations of the flow.
    #[must_use]
    pub fn in_evaluations(&self) -> f64 {
        EVALUATING.iter().map(|activity| self[Spending::Step(*activity)]).sum()
    }
}

/// What evaluates the flow.
const EVALUATING: [Activity; 4] =
    [Activity::RightHandSide, Activity::Linearisation, Activity::JacobianProduct, Activity::Check];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_has_a_place_of_its_own() {
        assert_eq!(Spending::ALL.map(Spending::place), std::array::from_fn(|place| place));
    }
}
