//! The terms of the energy that a scene names, and own ones.

use super::own_terms::OwnTerms;
use super::scene::{Scene, Start};
use super::setup_error::SetupError;
use crate::energies::EnergyTerm;

/// What the energies of a run need that its scene does not say.
#[derive(Clone, Debug)]
pub(super) struct Initial {
    /// Length of the initial curve.
    pub length: f64,
    /// Enclosed area of the initial curve, on the grid.
    pub area: f64,
    /// Whether it is a circle, run through once, as far as the tolerance goes.
    pub is_round: bool,
    /// Terms from outside.
    pub own: OwnTerms,
}

/// The terms of the energy that the checked scene names, then own ones, for `nodes` nodes.
///
/// # Errors
/// [`SetupError::Expression`] if a derivative of an expression is too large.
pub(super) fn energy_terms(
    scene: &Scene,
    initial: &Initial,
    nodes: usize,
) -> Result<Vec<Box<dyn EnergyTerm>>, SetupError> {
    let start = Start { densities: &scene.density, length: initial.length, area: initial.area, nodes };
    let terms = scene.energy.terms(&start).collect::<Result<Vec<_>, _>>();
    let mut terms = terms.map_err(|(key, fault)| SetupError::Expression { key, fault })?;
    terms.extend(initial.own.on(nodes));
    Ok(terms)
}
