//! The terms of the energy that a scene names, and own ones.

use super::own_terms::OwnTerms;
use super::scene::{self, Scene};
use super::setup_error::SetupError;
use crate::energies::{
    Adhesion, Agents, Area, Bending, CutOff, EnergyTerm, Length, Local, Membrane, NodalLines, Packing,
    Regularization,
};
use crate::expression::{Expression, ExpressionError};

/// What the energies of a run need that its scene does not say.
#[derive(Clone, Debug)]
pub(super) struct Initial {
    /// Length of the initial curve.
    pub length: f64,
    /// Enclosed area of the initial curve, on the grid.
    pub area: f64,
    /// Terms from outside.
    pub own: OwnTerms,
}

/// The terms of the energy that the scene names, then own ones, for `nodes` nodes.
///
/// # Errors
/// [`SetupError::Expression`] if a derivative of an expression is too large.
pub(super) fn energy_terms(
    scene: &Scene,
    initial: &Initial,
    nodes: usize,
) -> Result<Vec<Box<dyn EnergyTerm>>, SetupError> {
    let energy = &scene.energy;
    let at = |key: &'static str| move |fault: ExpressionError| SetupError::Expression { key, fault };
    let mut terms: Vec<Box<dyn EnergyTerm>> = Vec::new();
    if let Some(bending) = &energy.bending {
        let term = self::bending(scene, bending, nodes).map_err(at("energy.bending.preferred_curvature"));
        terms.push(Box::new(term?));
    }
    if let Some(regularization) = &energy.regularization {
        terms.push(Box::new(Regularization::new(regularization.delta)));
    }
    if let Some(length) = &energy.length {
        terms.push(Box::new(self::length(length, initial.length)));
    }
    if let Some(area) = &energy.area {
        terms.push(Box::new(self::area(area, initial.area)));
    }
    if let Some(adhesion) = &energy.adhesion {
        let cut_off = adhesion.cutoff.map_or(CutOff::Automatic { length: initial.length }, CutOff::At);
        let term = Adhesion::new(adhesion.kernel.expression(), cut_off, nodes);
        terms.push(Box::new(term.map_err(at("energy.adhesion.kernel"))?));
    }
    if let Some(agents) = &energy.agents {
        terms.push(Box::new(self::agents(scene, agents, nodes).map_err(at("energy.agents"))?));
    }
    if let Some(membrane) = &energy.membrane {
        terms.push(Box::new(Membrane::new(density(scene, &membrane.density), membrane.epsilon)));
    }
    if let Some(packing) = &energy.packing {
        terms.push(Box::new(Packing::new(&packing.matrix, packing.epsilon, nodes)));
    }
    if let Some(local) = &energy.local {
        terms.push(Box::new(self::local(scene, local, nodes).map_err(at("energy.local.expression"))?));
    }
    terms.extend(initial.own.on(nodes));
    Ok(terms)
}

/// Index of a density that the scene, which was checked, has.
fn density(scene: &Scene, name: &str) -> usize {
    scene.density.iter().position(|density| density.name == name).unwrap_or_default()
}

fn bending(scene: &Scene, bending: &scene::Bending, nodes: usize) -> Result<Bending, ExpressionError> {
    let Some(preferred) = bending.preferred_curvature.as_ref().map(scene::Formula::expression) else {
        return Ok(Bending::new(bending.rigidity));
    };
    match &bending.density {
        Some(name) if preferred.depends_on(0) => {
            Bending::around_function(bending.rigidity, preferred, density(scene, name), nodes)
        }
        _ => Ok(Bending::around(bending.rigidity, preferred.evaluate(&[0.0]))),
    }
}

fn area(area: &scene::Area, initial: f64) -> Area {
    match area {
        scene::Area::Pressure { pressure } => Area::Pressure(*pressure),
        scene::Area::Penalty { penalty, target } => Area::Penalty {
            penalty: *penalty,
            target: match target {
                scene::AreaTarget::Absolute(target) => *target,
                scene::AreaTarget::Ratio(ratio) => ratio * initial,
            },
        },
    }
}

fn length(length: &scene::Length, initial_length: f64) -> Length {
    match length {
        scene::Length::Tension { tension } => Length::Tension(*tension),
        scene::Length::Penalty { penalty, target } => Length::Penalty {
            penalty: *penalty,
            target: match target {
                scene::LengthTarget::Absolute(target) => *target,
                scene::LengthTarget::Ratio(ratio) => ratio * initial_length,
            },
        },
    }
}

/// The nodal lines of a scene's agents, as functions of κ (variable 0) and ρ (variable 1).
///
/// # Errors
/// [`ExpressionError`] never happens for formulas that were parsed once already.
pub fn nodal_lines(agents: &scene::Agents) -> Result<NodalLines, ExpressionError> {
    let parse = |formula: &scene::Formula| Expression::parse(&formula.text(), &["kappa", "rho"]);
    Ok(NodalLines {
        preferred_curvature: parse(&agents.preferred_curvature)?,
        low_density: parse(&agents.low_density)?,
        high_density: parse(&agents.high_density)?,
    })
}

fn agents(scene: &Scene, agents: &scene::Agents, nodes: usize) -> Result<Agents, ExpressionError> {
    Agents::new(density(scene, &agents.density), agents.epsilon, agents.delta, &nodal_lines(agents)?, nodes)
}

fn local(scene: &Scene, local: &scene::Local, nodes: usize) -> Result<Local, ExpressionError> {
    let names: Vec<&str> =
        std::iter::once("kappa").chain(scene.density.iter().map(|density| density.name.as_str())).collect();
    let slopes: Vec<String> = names.iter().map(|name| format!("{name}_sigma")).collect();
    let mut variables = names.clone();
    variables.extend(slopes.iter().map(String::as_str));
    let expression = Expression::parse(&local.expression.text(), &variables)?;
    Local::new(&expression, names.len(), nodes)
}
