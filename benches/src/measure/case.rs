//! A shipped scene with its number of nodes.

use flow_core::integrator::Problem;
use flow_core::run::{Scene, Setup};

use crate::rivals::{AuxiliaryFields, Shared};

/// Name in tables of the linear solver [`AuxiliaryFields`].
pub const AUXILIARY: &str = "auxiliary";

/// What is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name of the shipped scene.
    pub scene: &'static str,
    /// Number of nodes.
    pub nodes: usize,
    /// Family of the discrete derivative, by its name in scenes.
    pub derivative: &'static str,
}

impl Case {
    /// The flow and its initial state, with a linear solver by its name in scenes.
    ///
    /// # Panics
    /// If there is no such scene or solver: both are names in this program.
    #[must_use]
    pub fn build(&self, linear_solver: &str) -> Setup {
        let (_, text) = Scene::shipped()
            .iter()
            .find(|(name, _)| *name == self.scene)
            .expect("the cases name shipped scenes");
        let overrides = [
            ("accuracy.nodes".to_owned(), self.nodes.to_string()),
            ("accuracy.derivative".to_owned(), self.derivative.to_owned()),
            ("accuracy.linear_solver".to_owned(), linear_solver.to_owned()),
        ];
        let scene = Scene::parse_with(text, self.scene, &overrides).expect("shipped scenes are valid");
        Setup::new(&scene).expect("shipped scenes have an initial state")
    }

    /// The problem with a linear solver, one of the core's or [`AUXILIARY`]; a handle on its membrane; and its initial
    /// state.
    #[must_use]
    pub fn problem(&self, linear_solver: &str) -> (Box<dyn Problem>, Shared, Vec<f64>) {
        let auxiliary = linear_solver == AUXILIARY;
        // The band brings its own preconditioner: the core's is the cheapest then.
        let Setup { membrane, state, .. } = self.build(if auxiliary { "fourier" } else { linear_solver });
        let shared = Shared::new(membrane);
        let problem: Box<dyn Problem> =
            if auxiliary { Box::new(AuxiliaryFields::new(shared.clone())) } else { Box::new(shared.clone()) };
        (problem, shared, state)
    }
}
