//! From a checked scene to a flow and its initial state.

use std::sync::Arc;

use super::diagnostics::Diagnostics;
use super::energy_terms::{Initial, energy_terms};
use super::grading::{grading, resample};
use super::membrane::Membrane;
use super::mobilities::{density_mobilities, normal_mobility};
use super::resolution;
use super::scene::{self, Gauge, Scene};
use super::setup_error::SetupError;
use super::switches::Switches;
use crate::flow::{EnergySum, FlowMap, GradientFlow, LinearSolver};
use crate::geometry::shapes::{Resampled, Shape};
use crate::geometry::{
    Closure, Embedding, Grading, Layout, PeriodicGrid, Placement, SpectralLayout, enclosed_area,
};
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
    /// What frames hold on request.
    pub diagnostics: Diagnostics,
    /// Gap of the initial curve before it was closed.
    pub closure_defect: f64,
    /// Changes of the gauge to come.
    pub switches: Switches,
    /// What the energies refer to.
    pub(super) initial: Initial,
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
        let grading = grading(scene, nodes)?;
        let curve = resample(&shape, nodes, grading.as_deref())?;
        check_turning(scene, &curve)?;
        let layout = layout(scene, nodes);
        let (state, closure_defect) = initial_state(scene, &curve, layout, grading.as_ref())?;
        let area = area(&state, layout, &curve, grading.clone());
        let initial = Initial { length: initial_length, area };
        let (flow, diagnostics) = flow(scene, initial, nodes, grading)?;
        let solver = linear_solver(scene.accuracy.linear_solver);
        let membrane = Membrane::new(flow, solver, curve.turning_number, curve.angle);
        let placement = Placement { angle: curve.angle, centre: curve.centre };
        let switches = Switches::new(scene, initial, nodes)?;
        Ok(Self { membrane, state, placement, diagnostics, closure_defect, switches, initial })
    }
}

/// Shape of the states of a scene on `nodes` nodes.
fn layout(scene: &Scene, nodes: usize) -> Layout {
    let layout = Layout::new(nodes, scene.density.len());
    if scene.flow.gauge == Gauge::CoMoving { layout.with_metric() } else { layout }
}

/// The flow of a scene on `nodes` nodes, and what frames hold on request.
pub(super) fn flow(
    scene: &Scene,
    initial: Initial,
    nodes: usize,
    grading: Option<Arc<Grading>>,
) -> Result<(GradientFlow, Diagnostics), SetupError> {
    let layout = layout(scene, nodes);
    let grid = PeriodicGrid::new(nodes);
    let derivative = Derivative::graded(family(scene.accuracy.derivative), &grid, grading);
    let terms = energy_terms(scene, initial, nodes)?;
    let diagnostics = Diagnostics::new(scene, initial, layout, &derivative)?;
    let energy = EnergySum::new(terms, layout, &grid, &derivative);
    let map = FlowMap::new(layout, &grid, &derivative);
    let normal = normal_mobility(scene.flow.normal_mobility, &grid, &derivative);
    let mobilities = density_mobilities(scene, &grid, &derivative)?;
    Ok((GradientFlow::new(map, energy, layout, normal, mobilities), diagnostics))
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
    grading: Option<&Arc<Grading>>,
) -> Result<(Vec<f64>, f64), SetupError> {
    let nodes = layout.nodes();
    let uniform = || (0..nodes).map(|i| i as f64 / nodes as f64).collect();
    let fractions: Vec<f64> = grading.map_or_else(uniform, |grading| grading.fractions());
    let mut densities = Vec::new();
    for density in &scene.density {
        let values = density.initial.values(&fractions);
        if let Some(node) = values.iter().position(|value| !value.is_finite()) {
            return Err(SetupError::DensityNotFinite {
                density: density.name.clone(),
                node,
                parameter: fractions[node],
                value: values[node],
            });
        }
        densities.push(values);
    }
    let mut nodal = layout.assemble(&curve.curvature, &densities, curve.length);
    if let Some(grading) = grading {
        grading.weigh(&mut nodal[..layout.length_index()]); // the metric too, where it is a field
    }
    let spectral = SpectralLayout::new(layout);
    let mut state = vec![0.0; spectral.len()];
    spectral.encode(&mut PeriodicGrid::new(nodes), &nodal, &mut state);
    let turning = &mut spectral.spectra_mut(&mut state)[..spectral.modes()];
    let gap = Closure::graded(nodes, grading.cloned()).project(
        turning,
        curve.length,
        curve.turning_number,
        curve.angle,
    );
    match gap {
        Ok(gap) if gap <= LARGEST_GAP * curve.length => Ok((state, gap)),
        _ => {
            let gap = gap.unwrap_or_else(|error| error.gap);
            Err(SetupError::TooFewNodes { nodes, gap, bound: LARGEST_GAP * curve.length })
        }
    }
}

/// Area enclosed by the closed initial curve, as the energies measure it.
fn area(state: &[f64], layout: Layout, curve: &Resampled, grading: Option<Arc<Grading>>) -> f64 {
    let spectral = SpectralLayout::new(layout);
    let mut embedding = Embedding::graded(layout.nodes(), grading);
    embedding.set_tangent_spectrum(&spectral.spectra(state)[..spectral.modes()], curve.length, 0.0);
    embedding.set_position(curve.length, [0.0; 2]);
    enclosed_area(embedding.position(), embedding.tangent(), curve.length)
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

pub(super) fn linear_solver(solver: scene::LinearSolver) -> LinearSolver {
    match solver {
        scene::LinearSolver::Auto => LinearSolver::Auto,
        scene::LinearSolver::Fourier => LinearSolver::Fourier,
        scene::LinearSolver::Banded => LinearSolver::Banded,
        scene::LinearSolver::Dense => LinearSolver::Dense,
    }
}
