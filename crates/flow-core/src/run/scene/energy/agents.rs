//! `[energy.agents]`: a density of curvature agents,
//! `∫ (δ/2)|∇_sκ|² + f(κ, ρ)/δ + (ε/2)|∇_sρ|² + F(κ, ρ)/ε dσ` with
//! `f = (κ − κ₀(ρ))²/2` and `F = 4 (ρ − ρ₋(κ))² (ρ − ρ₊(κ))²`.

use schemars::JsonSchema;
use serde::Serialize;

use super::known::known_density;
use super::{EnergyTable, Start, Term};
use crate::energies::{self, NodalLines};
use crate::run::scene::error::Bound;
use crate::run::scene::formula::Formula;
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the curvature agents.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Agents {
    /// Name of the density ρ.
    pub density: String,
    /// Width ε > 0 of the fronts between low and high density.
    #[schemars(transform = Within(Bound::Positive))]
    pub epsilon: f64,
    /// Width δ > 0 of changes of curvature.
    #[schemars(transform = Within(Bound::Positive))]
    pub delta: f64,
    /// Preferred curvature κ₀, an expression of `rho`.
    pub preferred_curvature: Formula,
    /// Low density ρ₋, an expression of `kappa`.
    pub low_density: Formula,
    /// High density ρ₊, an expression of `kappa`.
    pub high_density: Formula,
}

impl EnergyTable for Agents {
    fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let density = section.required("density", "density = \"protein\"");
        let density = density.and_then(|entry| known_density(&entry, densities));
        let epsilon = section.required("epsilon", "epsilon = 0.05");
        let epsilon = epsilon.and_then(|entry| entry.number(Bound::Positive, "try epsilon = 0.05"));
        let delta = section.required("delta", "delta = 0.2");
        let delta = delta.and_then(|entry| entry.number(Bound::Positive, "try delta = 0.2"));
        let preferred = section.required("preferred_curvature", "preferred_curvature = \"1.3 - 2.6*rho\"");
        let preferred = preferred.and_then(|entry| entry.formula(&["rho"]));
        let low = section.required("low_density", "low_density = \"0.05 + 0.16*exp(-(kappa - 1)^2)\"");
        let low = low.and_then(|entry| entry.formula(&["kappa"]));
        let high = section.required("high_density", "high_density = \"0.8 + 0.18*exp(-(kappa + 0.3)^2)\"");
        let high = high.and_then(|entry| entry.formula(&["kappa"]));
        section.finish();
        Some(Self {
            density: density?,
            epsilon: epsilon?,
            delta: delta?,
            preferred_curvature: preferred?,
            low_density: low?,
            high_density: high?,
        })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        let line = |formula: &Formula| formula.expression().over(&["kappa", "rho"]);
        let lines = NodalLines {
            preferred_curvature: line(&self.preferred_curvature),
            low_density: line(&self.low_density),
            high_density: line(&self.high_density),
        };
        let density = start.density(&self.density);
        let term = energies::Agents::new(density, self.epsilon, self.delta, &lines, start.nodes);
        Ok(Box::new(term.map_err(|fault| ("energy.agents", fault))?))
    }

    fn front_width(&self) -> Option<f64> {
        Some(self.epsilon.min(self.delta))
    }
}
