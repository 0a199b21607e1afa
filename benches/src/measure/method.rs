//! The methods, each built for a case and run by the core's step loop.

use flow_core::integrator::{Bdf, Finish, INTEGRALS, Integrals, Multistep, Problem};
use flow_core::run::ENERGY_TOLERANCE_SHARE;

use super::case::Case;
use super::outcome::{Goal, Outcome, drive};
use crate::rivals::tableau::{ESDIRK43, ROS34PW2};
use crate::rivals::{Esdirk, Etdrk4, Formula, OneStep, Rosenbrock, Shared};

/// A way to integrate in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The program's: exponential Adams steps while the rest is not stiff, then BDF.
    Program,
    /// The core's variable-order BDF.
    Bdf,
    /// Rosenbrock–W, order 3(2).
    Rosenbrock,
    /// ESDIRK, order 4(3).
    Esdirk,
    /// Exponential, order 4(3).
    Etdrk4,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Program, Self::Bdf, Self::Rosenbrock, Self::Esdirk, Self::Etdrk4];

    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Program => "exponential, then BDF",
            Self::Bdf => "BDF 1–5",
            Self::Rosenbrock => ROS34PW2.name,
            Self::Esdirk => ESDIRK43.name,
            Self::Etdrk4 => "ETDRK4(3)",
        }
    }

    /// Whether the method solves linear systems with a solver that can be chosen.
    #[must_use]
    pub fn is_implicit(self) -> bool {
        self != Self::Etdrk4 && self != Self::Program
    }

    /// Integrates `case` to `end` with the linear solver `solver` (see [`Case::problem`]), or until `limit` seconds have
    /// passed.
    ///
    /// # Panics
    /// If the initial state is not finite: the shipped scenes are.
    #[must_use]
    pub fn run(self, case: Case, solver: &str, tolerance: f64, end: f64, limit: f64) -> Outcome {
        let (mut problem, shared, mut state) = case.problem(solver);
        let Finish::Good { energy, integral_rates, .. } = problem.finish(0.0, &mut state) else {
            panic!("the initial state of `{}` is finite", case.scene);
        };
        let goal = Goal { end, limit, energy, energy_tolerance: ENERGY_TOLERANCE_SHARE * tolerance };
        match self.formula(&shared) {
            None if self == Self::Program => drive(&mut *problem, goal, |problem, counters| {
                let integrals = Integrals::new(0.0, [0.0; INTEGRALS], integral_rates);
                Multistep::starting(problem, &state, integrals, tolerance, counters)
            }),
            None => drive(&mut *problem, goal, |problem, counters| {
                Bdf::new(problem, &state, integral_rates, tolerance, counters)
            }),
            Some(formula) => drive(&mut *problem, goal, |problem, counters| {
                OneStep::new(formula, problem, &state, integral_rates, tolerance, counters)
            }),
        }
    }

    /// The formula of a one-step method; none for a multistep method.
    #[must_use]
    pub fn formula(self, problem: &Shared) -> Option<Box<dyn Formula>> {
        let size = problem.size();
        match self {
            Self::Program | Self::Bdf => None,
            Self::Rosenbrock => Some(Box::new(Rosenbrock::new(&ROS34PW2, size))),
            Self::Esdirk => Some(Box::new(Esdirk::new(&ESDIRK43, size))),
            Self::Etdrk4 => Some(Box::new(Etdrk4::new(problem.clone()))),
        }
    }
}
