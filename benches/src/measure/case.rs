//! A shipped scene with its number of nodes.

use flow_core::run::{Scene, Setup};

/// What is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name of the shipped scene.
    pub scene: &'static str,
    /// Number of nodes.
    pub nodes: usize,
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
            ("accuracy.linear_solver".to_owned(), linear_solver.to_owned()),
        ];
        let scene = Scene::parse_with(text, self.scene, &overrides).expect("shipped scenes are valid");
        Setup::new(&scene).expect("shipped scenes have an initial state")
    }
}
