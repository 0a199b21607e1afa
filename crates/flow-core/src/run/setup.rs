//! From a checked scene to a flow and its initial state.

use std::sync::Arc;

use super::adaptation::{Adaptation, unresolved_bound};
use super::choices::{family, linear_solver, shape};
use super::diagnostics::Diagnostics;
use super::energy_terms::{Initial, energy_terms};
use super::gauges::Gauges;
use super::limits;
use super::membrane::Membrane;
use super::mesh::Mesh;
use super::mobilities::{density_mobilities, normal_mobility};
use super::own_terms::{OwnTerms, check_names};
use super::resolution::{self, MOST_NODES, needed_nodes, size_above, unresolved};
use super::scene::{Nodes, Scene};
use super::setup_error::SetupError;
use crate::energies::EnergyTerm;
use crate::flow::{EnergySum, FlowMap, GradientFlow, MetricRole};
use crate::geometry::shapes::{Resampled, Shape};
use crate::geometry::{
    Closure, Embedding, Grading, GradingError, Layout, PeriodicGrid, Placement, SpectralLayout, enclosed_area,
};
use crate::operators::Derivative;

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
    /// The gauge in force and those to come.
    pub gauges: Gauges,
    /// The nodes at the start.
    pub mesh: Mesh,
    /// Chooses them, if the scene leaves that to the program.
    pub adaptation: Option<Adaptation>,
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
        Self::with(scene, OwnTerms::default())
    }

    /// The same with the terms that `terms` makes for a number of nodes, after those of the scene.
    ///
    /// # Errors
    /// As [`Setup::new`], and [`SetupError::TermName`].
    pub fn with_terms(
        scene: &Scene,
        terms: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static,
    ) -> Result<Self, SetupError> {
        Self::with(scene, OwnTerms::made_by(terms))
    }

    pub(super) fn with(scene: &Scene, own: OwnTerms) -> Result<Self, SetupError> {
        let shape = shape(&scene.curve.shape);
        let initial_length = shape.length()?;
        let Start { mesh, grading, curve, state, closure_defect } =
            start(scene, &shape, initial_length, &own)?;
        let layout = layout(scene, mesh.nodes);
        let area = area(&state, layout, &curve, grading.clone());
        let initial = Initial { length: initial_length, area, own };
        let (flow, diagnostics) = flow(scene, &initial, mesh.nodes, grading)?;
        check_names(flow.energy_terms().names())?;
        limits::check(scene, layout, diagnostics.field_names().len())?;
        let solver = linear_solver(scene.accuracy.linear_solver);
        let membrane = Membrane::new(flow, solver, curve.turning_number, curve.angle);
        let placement = Placement { angle: curve.angle, centre: curve.centre };
        let gauges = Gauges::new(scene, &initial, &mesh)?;
        let adaptation = Adaptation::of(scene);
        Ok(Self {
            membrane,
            state,
            placement,
            diagnostics,
            closure_defect,
            gauges,
            mesh,
            adaptation,
            initial,
        })
    }
}

/// The initial curve on its nodes.
struct Start {
    mesh: Mesh,
    grading: Option<Arc<Grading>>,
    curve: Resampled,
    state: Vec<f64>,
    closure_defect: f64,
}

/// Nodes on which the initial data are looked at first, and the most that they get: data with kinks need any number, and the
/// flow smooths them.
const FIRST_NODES: usize = 256;
const MOST_FIRST_NODES: usize = 4096;
/// Part that a kink leaves unresolved; more than that is a curve that the nodes miss.
const SMOOTHED: f64 = 1e-2;

/// As many nodes as the scene says, or as its initial data need.
fn start(scene: &Scene, shape: &Shape, length: f64, own: &OwnTerms) -> Result<Start, SetupError> {
    let nodes = match scene.accuracy.nodes {
        Nodes::Count(nodes) => return start_on(scene, shape, nodes),
        Nodes::Auto => FIRST_NODES,
    };
    let fronts = resolution::fronts(scene, length);
    if scene.flow.gauge.metric() != MetricRole::Graded && fronts > MOST_NODES as f64 {
        let remedy = "make epsilon or delta larger, let nodes follow the fronts (flow.gauge = \"graded\")";
        return Err(SetupError::TooManyNodes { needed: fronts, most: MOST_NODES, remedy });
    }
    let (mut nodes, family) = (nodes, family(scene, false));
    let least = length / largest_spacing(scene, length, own)?;
    if least > MOST_NODES as f64 {
        let remedy = "make the kernel of adhesion wider, take a looser tolerance";
        return Err(SetupError::TooManyNodes { needed: least, most: MOST_NODES, remedy });
    }
    loop {
        match start_on(scene, shape, nodes) {
            Ok(start) => {
                let aim = unresolved_bound(scene);
                let needed =
                    needed_nodes(layout(scene, nodes), &start.state, aim, family).max(size_above(least));
                let smooths = unresolved(layout(scene, nodes), &start.state, nodes, family) < SMOOTHED;
                if needed == nodes || (needed > nodes && nodes >= MOST_FIRST_NODES && smooths) {
                    return Ok(start);
                }
                if needed > MOST_NODES {
                    let remedy = match family.order() {
                        None => "smooth the curve, take a looser tolerance",
                        Some(_) => "take the derivative \"auto\", a looser tolerance",
                    };
                    return Err(SetupError::TooManyNodes { needed: needed as f64, most: MOST_NODES, remedy });
                }
                let fewer = needed < nodes;
                nodes = needed.max(resolution::LEAST_NODES);
                if fewer {
                    return start_on(scene, shape, nodes);
                }
            }
            // Nodes that miss a lobe count its turns wrongly.
            Err(SetupError::TurningNumber { .. }) if nodes < MOST_FIRST_NODES => nodes *= 2,
            Err(error) if nodes >= MOST_NODES => return Err(error),
            Err(SetupError::TooFewNodes { .. } | SetupError::Grading(GradingError::NotResolved { .. })) => {
                nodes *= 2;
            }
            Err(error) => return Err(error),
        }
    }
}

/// Largest distance of nodes that the energies of positions allow on the initial curve.
fn largest_spacing(scene: &Scene, length: f64, own: &OwnTerms) -> Result<f64, SetupError> {
    if scene.energy.adhesion.is_none() && !own.exist() {
        return Ok(f64::INFINITY); // the others do not ask for any
    }
    let terms = energy_terms(scene, &Initial { length, area: 0.0, own: own.clone() }, FIRST_NODES)?;
    let error = unresolved_bound(scene);
    Ok(terms.iter().map(|term| term.largest_spacing(length, error)).fold(f64::INFINITY, f64::min))
}

fn start_on(scene: &Scene, shape: &Shape, nodes: usize) -> Result<Start, SetupError> {
    let mesh = Mesh::of(nodes);
    let grading = mesh.grading(scene)?;
    let curve = match &grading {
        None => shape.resample(nodes)?,
        Some(grading) => shape.resample_graded(grading)?,
    };
    check_turning(scene, &curve)?;
    let (state, closure_defect) = initial_state(scene, &curve, layout(scene, nodes), grading.as_ref())?;
    Ok(Start { mesh, grading, curve, state, closure_defect })
}

/// Shape of the states of a scene on `nodes` nodes.
fn layout(scene: &Scene, nodes: usize) -> Layout {
    let layout = Layout::new(nodes, scene.density.len());
    if scene.flow.gauge.metric() == MetricRole::Field { layout.with_metric() } else { layout }
}

/// The flow of a scene on `nodes` nodes, and what frames hold on request.
pub(super) fn flow(
    scene: &Scene,
    initial: &Initial,
    nodes: usize,
    grading: Option<Arc<Grading>>,
) -> Result<(GradientFlow, Diagnostics), SetupError> {
    let layout = layout(scene, nodes);
    let grid = PeriodicGrid::new(nodes);
    let family = family(scene, grading.is_some());
    let terms = energy_terms(scene, initial, nodes)?;
    let build = if terms.iter().any(|term| term.has_slope_density()) {
        Derivative::staggered
    } else {
        Derivative::graded
    };
    let derivative = build(family, &grid, grading);
    let diagnostics = Diagnostics::new(scene, initial, layout, &derivative)?;
    let energy = EnergySum::new(terms, layout, &grid, &derivative);
    let map = FlowMap::in_gauge(scene.flow.gauge.rule(), layout, &grid, &derivative);
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
