//! `[energy.bending]`: `∫ (b/2) (κ − c₀)² dσ`.

use schemars::JsonSchema;
use serde::Serialize;

use super::known::known_density;
use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::entry::Entry;
use crate::run::scene::error::{Bound, Fault};
use crate::run::scene::formula::Formula;
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the bending energy.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Bending {
    /// Bending rigidity b ≥ 0, in energy × length.
    #[schemars(transform = Within(Bound::AtLeast(0.0)))]
    pub rigidity: f64,
    /// Preferred curvature c₀, a number or an expression of `rho`; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preferred_curvature: Option<Formula>,
    /// Name of the density ρ that c₀ depends on, if it does: the only one of the scene unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density: Option<String>,
}

impl EnergyTable for Bending {
    fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let rigidity = section.required("rigidity", "rigidity = 1.0");
        let rigidity = rigidity.and_then(|entry| entry.number(Bound::AtLeast(0.0), "try rigidity = 1.0"));
        let preferred = section.get("preferred_curvature");
        let preferred = preferred.map_or(Some(None), |entry| of_density(&entry, densities).map(Some));
        let depends = preferred.as_ref().is_some_and(|preferred| {
            preferred.as_ref().is_some_and(|formula| formula.expression().depends_on(0))
        });
        let density = if depends && densities.len() > 1 {
            section.required("density", "density = \"protein\", the density that `rho` stands for")
        } else {
            section.get("density")
        };
        let density = match density {
            Some(entry) => known_density(&entry, densities).map(Some),
            None if depends && densities.len() > 1 => None,
            None => Some(densities.first().filter(|_| depends).cloned()),
        };
        section.finish();
        Some(Self { rigidity: rigidity?, preferred_curvature: preferred?, density: density? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        let Some(preferred) = self.preferred_curvature.as_ref().map(Formula::expression) else {
            return Ok(Box::new(energies::Bending::new(self.rigidity)));
        };
        let Some(density) = self.density.as_ref().filter(|_| preferred.depends_on(0)) else {
            return Ok(Box::new(energies::Bending::around(self.rigidity, preferred.evaluate(&[0.0]))));
        };
        let density = start.density(density);
        let term = energies::Bending::around_function(self.rigidity, preferred, density, start.nodes);
        Ok(Box::new(term.map_err(|fault| ("energy.bending.preferred_curvature", fault))?))
    }
}

/// A formula of `rho`, which must have a meaning if it occurs.
fn of_density(entry: &Entry<'_>, densities: &[String]) -> Option<Formula> {
    let formula = entry.formula(&["rho"])?;
    if densities.is_empty() && formula.expression().depends_on(0) {
        entry.fault(Fault::NoDensity { needs: "depends on `rho`" });
        return None;
    }
    Some(formula)
}
