//! `[energy.local]`: `∫ e(κ, ∇_sκ, ρ, ∇_sρ) dσ` with a user's expression.

use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::formula::Formula;
use crate::run::scene::section::Section;

/// Parameters of a general local energy.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Local {
    /// Energy per unit arc length: an expression of `kappa`, `kappa_sigma`, then `name` and `name_sigma` of each density
    /// in order, where `_sigma` is the derivative by arc length.
    pub expression: Formula,
}

impl EnergyTable for Local {
    fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let mut variables = vec!["kappa".to_owned(), "kappa_sigma".to_owned()];
        for name in densities {
            variables.extend([name.clone(), format!("{name}_sigma")]);
        }
        let variables: Vec<&str> = variables.iter().map(String::as_str).collect();
        let expression = section.required("expression", "expression = \"0.5*kappa^2 + 0.1*kappa_sigma^2\"");
        let expression = expression.and_then(|entry| entry.formula(&variables));
        section.finish();
        Some(Self { expression: expression? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        let densities = start.densities.iter().map(|density| density.name.as_str());
        let fields: Vec<&str> = std::iter::once("kappa").chain(densities).collect();
        let slopes: Vec<String> = fields.iter().map(|name| format!("{name}_sigma")).collect();
        let variables: Vec<&str> = fields.iter().copied().chain(slopes.iter().map(String::as_str)).collect();
        let expression = self.expression.expression().over(&variables);
        let term = energies::Local::new(&expression, fields.len(), start.nodes);
        Ok(Box::new(term.map_err(|fault| ("energy.local.expression", fault))?))
    }
}
