//! From a checked scene to a flow and its initial state.

use super::membrane::Membrane;
use super::mobilities::{density_mobilities, normal_mobility};
use super::resolution;
use super::scene::{self, Scene};
use super::setup_error::SetupError;
use crate::energies::{Agents, Bending, EnergyTerm, Length, Local, NodalLines, Regularization};
use crate::expression::{Expression, ExpressionError, Program};
use crate::flow::{EnergySum, FlowMap, GradientFlow, LinearSolver};
use crate::geometry::shapes::{Resampled, Shape};
use crate::geometry::{Closure, Layout, PeriodicGrid, Placement, SpectralLayout};
use crate::operators::{Derivative, DerivativeFamily};

/// A flow with its initial state.
#[derive(Debug)]
pub struct Setup {
    /// The problem.
    pub membrane: Membrane,
    /// The initial state (spectral), closed to rounding.
    pub state: Vec<f64>,
    /// Where the initial curve lies.
    pub placement: Placement,
    /// Gap of the initial curve before it was closed.
    pub closure_defect: f64,
}

/// Largest gap, relative to the length, that is closed on input without complaint.
const LARGEST_GAP: f64 = 1e-2;

impl Setup {
    /// Builds what the scene names, and nothing else.
    ///
    /// # Errors
    /// [`SetupError`] if the curve or the data of the scene make no initial state.
    pub fn new(scene: &Scene) -> Result<Self, SetupError> {
        let shape = shape(&scene.curve.shape);
        let initial_length = shape.length()?;
        let nodes = resolution::nodes(scene, &shape, initial_length)?;
        let curve = shape.resample(nodes)?;
        check_turning(scene, &curve)?;
        let layout = Layout::new(nodes, scene.density.len());
        let mut closure = Closure::new(nodes);
        let (state, closure_defect) = initial_state(scene, &curve, layout, &mut closure)?;
        let grid = PeriodicGrid::new(nodes);
        let derivative = Derivative::new(family(scene.accuracy.derivative), &grid);
        let terms = energy_terms(scene, initial_length, nodes)?;
        let energy = EnergySum::new(terms, layout, &grid, &derivative);
        let map = FlowMap::new(layout, &grid, &derivative);
        let normal = normal_mobility(scene.flow.normal_mobility, &grid, &derivative);
        let mobilities = density_mobilities(scene, &grid, &derivative)?;
        let flow = GradientFlow::new(map, energy, layout, normal, mobilities);
        let solver = linear_solver(scene.accuracy.linear_solver);
        let membrane = Membrane::new(flow, solver, curve.turning_number, curve.angle);
        let placement = Placement { angle: curve.angle, centre: curve.centre };
        Ok(Self { membrane, state, placement, closure_defect })
    }
}

fn check_turning(scene: &Scene, curve: &Resampled) -> Result<(), SetupError> {
    if curve.turning_number == scene.curve.turning_number {
        return Ok(());
    }
    Err(SetupError::TurningNumber { found: curve.turning_number, expected: scene.curve.turning_number })
}

/// State vector of the initial curve and densities, closed; and the gap that was closed.
fn initial_state(
    scene: &Scene,
    curve: &Resampled,
    layout: Layout,
    closure: &mut Closure,
) -> Result<(Vec<f64>, f64), SetupError> {
    let nodes = layout.nodes();
    let parameter: Vec<f64> = (0..nodes).map(|i| i as f64 / nodes as f64).collect();
    let mut densities = Vec::new();
    for density in &scene.density {
        let mut values = vec![0.0; nodes];
        let program = Program::compile(&[density.initial.expression()]);
        let mut scratch = vec![0.0; program.scratch_len()];
        program.evaluate(&[&parameter], &mut [&mut values], &mut scratch);
        if let Some(node) = values.iter().position(|value| !value.is_finite()) {
            return Err(SetupError::DensityNotFinite {
                density: density.name.clone(),
                node,
                parameter: parameter[node],
                value: values[node],
            });
        }
        densities.push(values);
    }
    let nodal = layout.assemble(&curve.curvature, &densities, curve.length);
    let spectral = SpectralLayout::new(layout);
    let mut state = vec![0.0; spectral.len()];
    spectral.encode(&mut PeriodicGrid::new(nodes), &nodal, &mut state);
    let turning = &mut spectral.spectra_mut(&mut state)[..spectral.modes()];
    let gap = closure.project(turning, curve.length, curve.turning_number, curve.angle);
    match gap {
        Ok(gap) if gap <= LARGEST_GAP * curve.length => Ok((state, gap)),
        _ => {
            let gap = gap.unwrap_or_else(|error| error.gap);
            Err(SetupError::TooFewNodes { nodes, gap, bound: LARGEST_GAP * curve.length })
        }
    }
}

/// The curve that a scene names.
#[must_use]
pub fn shape(shape: &scene::Shape) -> Shape {
    match shape {
        scene::Shape::Circle { radius } => Shape::Circle { radius: *radius },
        scene::Shape::Ellipse { semi_axes } => Shape::Ellipse { semi_axes: *semi_axes },
        scene::Shape::Trillium {} => Shape::Trillium,
        scene::Shape::FigureEight { size } => Shape::FigureEight { size: *size },
        scene::Shape::Polar { r } => Shape::Polar { r: r.expression().clone() },
        scene::Shape::Parametric { x, y } => {
            Shape::Parametric { x: x.expression().clone(), y: y.expression().clone() }
        }
        scene::Shape::Points { points } => Shape::Points(points.clone()),
    }
}

fn family(derivative: scene::Derivative) -> DerivativeFamily {
    match derivative {
        scene::Derivative::Fourier => DerivativeFamily::Fourier,
        scene::Derivative::Central2 => DerivativeFamily::Central2,
        scene::Derivative::Central4 => DerivativeFamily::Central4,
        scene::Derivative::Central6 => DerivativeFamily::Central6,
        scene::Derivative::Central8 => DerivativeFamily::Central8,
    }
}

fn linear_solver(solver: scene::LinearSolver) -> LinearSolver {
    match solver {
        scene::LinearSolver::Auto => LinearSolver::Auto,
        scene::LinearSolver::Fourier => LinearSolver::Fourier,
        scene::LinearSolver::Banded => LinearSolver::Banded,
        scene::LinearSolver::Dense => LinearSolver::Dense,
    }
}

/// The terms of the energy that the scene names.
fn energy_terms(
    scene: &Scene,
    initial_length: f64,
    nodes: usize,
) -> Result<Vec<Box<dyn EnergyTerm>>, SetupError> {
    let energy = &scene.energy;
    let mut terms: Vec<Box<dyn EnergyTerm>> = Vec::new();
    if let Some(bending) = &energy.bending {
        terms.push(Box::new(Bending::new(bending.rigidity)));
    }
    if let Some(regularization) = &energy.regularization {
        terms.push(Box::new(Regularization::new(regularization.delta)));
    }
    if let Some(length) = &energy.length {
        terms.push(Box::new(self::length(length, initial_length)));
    }
    if let Some(agents) = &energy.agents {
        let term = self::agents(scene, agents, nodes);
        terms.push(Box::new(term.map_err(|fault| SetupError::Expression { key: "energy.agents", fault })?));
    }
    if let Some(local) = &energy.local {
        let term = self::local(scene, local, nodes)
            .map_err(|fault| SetupError::Expression { key: "energy.local.expression", fault });
        terms.push(Box::new(term?));
    }
    Ok(terms)
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
    // The scene was checked: the density exists.
    let density = scene.density.iter().position(|density| density.name == agents.density).unwrap_or_default();
    Agents::new(density, agents.epsilon, agents.delta, &nodal_lines(agents)?, nodes)
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
