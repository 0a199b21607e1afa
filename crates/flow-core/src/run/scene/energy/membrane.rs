//! `[energy.membrane]`: `∫ (ρ − 1)²/(2ε) dσ`.

use schemars::JsonSchema;
use serde::Serialize;

use super::known::known_density;
use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::error::Bound;
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the penalty on stretching the membrane.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Membrane {
    /// Name of the membrane density ρ, 1 at rest.
    pub density: String,
    /// Compressibility ε > 0, in length / energy.
    #[schemars(transform = Within(Bound::Positive))]
    pub epsilon: f64,
}

impl EnergyTable for Membrane {
    fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let density = section.required("density", "density = \"membrane\"");
        let density = density.and_then(|entry| known_density(&entry, densities));
        let epsilon = section.required("epsilon", "epsilon = 0.01");
        let epsilon = epsilon.and_then(|entry| entry.number(Bound::Positive, "try epsilon = 0.01"));
        section.finish();
        Some(Self { density: density?, epsilon: epsilon? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        Ok(Box::new(energies::Membrane::new(start.density(&self.density), self.epsilon)))
    }
}
