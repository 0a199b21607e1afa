//! From a checked scene to a flow and its initial state.

use std::sync::Arc;

use super::adaptation::Adaptation;
use super::assembly::{flow, layout};
use super::choices::{linear_solver, shape};
use super::diagnostics::Diagnostics;
use super::energy_terms::Initial;
use super::gauges::Gauges;
use super::held_circle::{is_held, is_nearly_round};
use super::initial_state::InitialState;
use super::limits;
use super::membrane::Membrane;
use super::mesh::Mesh;
use super::own_terms::{OwnTerms, check_names};
use super::scene::Scene;
use super::setup_error::SetupError;
use crate::energies::EnergyTerm;
use crate::geometry::shapes::Resampled;
use crate::geometry::{Embedding, Grading, Layout, Placement, SpectralLayout, enclosed_area};

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
    pub(super) diagnostics: Diagnostics,
    /// Gap of the initial curve before it was closed.
    pub closure_defect: f64,
    /// The gauge in force and those to come.
    pub(super) gauges: Gauges,
    /// The nodes at the start.
    pub(super) mesh: Mesh,
    /// Chooses them, if the scene leaves that to the program.
    pub(super) adaptation: Option<Adaptation>,
    /// Whether the nodes miss so much of the initial data that no step counts as resolved.
    pub(super) misses_data: bool,
    /// What the energies refer to.
    pub(super) initial: Initial,
    /// Names of the densities.
    pub(super) densities: Vec<String>,
}

impl Setup {
    /// Builds what the scene names, and nothing else; if its values were changed since it was read, they are checked first.
    ///
    /// # Errors
    /// [`SetupError`] if the curve or the data of the scene make no initial state.
    pub fn new(scene: &Scene) -> Result<Self, SetupError> {
        Self::of(&scene.clone().checked()?, OwnTerms::default())
    }

    /// The same with the terms that `terms` makes for a number of nodes, after those of the scene.
    ///
    /// # Errors
    /// As [`Setup::new`], [`SetupError::TermName`] and [`SetupError::Undeclared`].
    pub fn with_terms(
        scene: &Scene,
        terms: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static,
    ) -> Result<Self, SetupError> {
        Self::of(&scene.clone().checked()?, OwnTerms::made_by(terms))
    }

    /// The same for a scene whose values are taken for checked.
    pub(super) fn of(scene: &Scene, own: OwnTerms) -> Result<Self, SetupError> {
        let curve = shape(&scene.curve.shape).by_arc_length()?;
        let initial_length = curve.length();
        let (InitialState { mesh, grading, curve, state, closure_defect }, misses_data) =
            InitialState::of(scene, &curve, &own)?;
        let layout = layout(scene, mesh.nodes);
        let area = area(&state, layout, &curve, grading.clone());
        let mut initial = Initial { length: initial_length, area, is_round: false, own };
        if is_nearly_round(scene, &curve) {
            let (mut free, _) = flow(scene, &initial, mesh.nodes, grading.clone())?;
            initial.is_round = is_held(&mut free, &state, scene, &curve);
        }
        let (mut flow, diagnostics) = flow(scene, &initial, mesh.nodes, grading)?;
        check_names(flow.energy_terms().names())?;
        if initial.own.exist() {
            flow.set_current(&state);
            flow.undeclared_part().map_or(Ok(()), Err)?;
        }
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
            misses_data,
            initial,
            densities: scene.density.iter().map(|density| density.name.clone()).collect(),
        })
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
