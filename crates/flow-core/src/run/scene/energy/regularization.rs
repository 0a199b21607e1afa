//! `[energy.regularization]`: `∫ (δ/2) |∇_sκ|² dσ`.

use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::error::Bound;
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the curvature regularisation.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Regularization {
    /// Weight δ > 0, in energy × length³.
    #[schemars(transform = Within(Bound::Positive))]
    pub delta: f64,
}

impl EnergyTable for Regularization {
    fn read(mut section: Section<'_>, _: &[String]) -> Option<Self> {
        let delta = section.required("delta", "delta = 0.2");
        let delta =
            delta.and_then(|entry| entry.number(Bound::Positive, "try delta = 0.2, or drop the table"));
        section.finish();
        Some(Self { delta: delta? })
    }

    fn term(&self, _: &Start<'_>) -> Term {
        Ok(Box::new(energies::Regularization::new(self.delta)))
    }
}
