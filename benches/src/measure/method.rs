//! The methods, each built for a case and run by the core's step loop.

use flow_core::integrator::{Bdf, Finish, INTEGRALS, Problem};
use flow_core::run::{ENERGY_TOLERANCE_SHARE, Setup};

use super::case::Case;
use super::outcome::{Goal, Outcome, drive};
use crate::rivals::tableau::{ESDIRK43, ROS34PW2};
use crate::rivals::{AuxiliaryFields, Esdirk, Etdrk4, Formula, OneStep, Rosenbrock, Shared};

/// Name in tables of the linear solver [`AuxiliaryFields`].
pub const AUXILIARY: &str = "auxiliary";

/// A way to integrate in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
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
    pub const ALL: [Self; 4] = [Self::Bdf, Self::Rosenbrock, Self::Esdirk, Self::Etdrk4];

    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bdf => "BDF 1–5",
            Self::Rosenbrock => ROS34PW2.name,
            Self::Esdirk => ESDIRK43.name,
            Self::Etdrk4 => "ETDRK4(3)",
        }
    }

    /// Whether the method solves linear systems.
    #[must_use]
    pub fn is_implicit(self) -> bool {
        self != Self::Etdrk4
    }

    /// Integrates `case` to `end`, or until `limit` seconds have passed. The linear solver is one of the core's, or
    /// [`AUXILIARY`].
    ///
    /// # Panics
    /// If the initial state is not finite: the shipped scenes are.
    #[must_use]
    pub fn run(self, case: Case, solver: &str, tolerance: f64, end: f64, limit: f64) -> Outcome {
        let auxiliary = solver == AUXILIARY;
        // The band brings its own preconditioner: the core's is the cheapest then.
        let Setup { mut membrane, mut state, .. } = case.build(if auxiliary { "fourier" } else { solver });
        let Finish::Good { energy, integral_rates, .. } = membrane.finish(0.0, &mut state) else {
            panic!("the initial state of `{}` is finite", case.scene);
        };
        let goal = Goal { end, limit, energy, energy_tolerance: ENERGY_TOLERANCE_SHARE * tolerance };
        let start = Start { state: &state, integral_rates, tolerance };
        let mut problem = Shared::new(membrane);
        let formula = self.formula(&problem);
        if auxiliary {
            integrate(formula, &mut AuxiliaryFields::new(problem), start, goal)
        } else {
            integrate(formula, &mut problem, start, goal)
        }
    }

    /// The formula of a one-step method; none for BDF.
    #[must_use]
    pub fn formula(self, problem: &Shared) -> Option<Box<dyn Formula>> {
        let size = problem.size();
        match self {
            Self::Bdf => None,
            Self::Rosenbrock => Some(Box::new(Rosenbrock::new(&ROS34PW2, size))),
            Self::Esdirk => Some(Box::new(Esdirk::new(&ESDIRK43, size))),
            Self::Etdrk4 => Some(Box::new(Etdrk4::new(problem.clone()))),
        }
    }
}

/// Where a method starts, and how exact it is to be.
#[derive(Clone, Copy)]
struct Start<'a> {
    state: &'a [f64],
    integral_rates: [f64; INTEGRALS],
    tolerance: f64,
}

/// One run, by BDF if there is no formula.
fn integrate(
    formula: Option<Box<dyn Formula>>,
    problem: &mut impl Problem,
    Start { state, integral_rates, tolerance }: Start<'_>,
    goal: Goal,
) -> Outcome {
    match formula {
        None => drive(problem, goal, |problem, counters| {
            Bdf::new(problem, state, integral_rates, tolerance, counters)
        }),
        Some(formula) => drive(problem, goal, |problem, counters| {
            OneStep::new(formula, problem, state, integral_rates, tolerance, counters)
        }),
    }
}
