//! `[energy.local]`: `∫ e(κ, ∇_sκ, ρ, ∇_sρ) dσ` with a user's expression.

use schemars::JsonSchema;
use serde::Serialize;

use crate::run::scene::formula::Formula;
use crate::run::scene::section::Section;

/// Parameters of a general local energy.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Local {
    /// Energy per unit arc length: an expression of `kappa`, `kappa_sigma`, then `name` and `name_sigma` of each density
    /// in order, where `_sigma` is the derivative by arc length.
    pub expression: Formula,
}

impl Local {
    pub(super) fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
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
}
