//! The initial state: on as many nodes as the scene says, or as its curve and densities need.

use std::sync::Arc;

use super::adaptation::unresolved_bound;
use super::assembly::layout;
use super::choices::family;
use super::energy_terms::{Initial, energy_terms};
use super::mesh::Mesh;
use super::missed::missed;
use super::own_terms::OwnTerms;
use super::resolution::{self, MOST_NODES, needed_nodes, size_above, unresolved};
use super::scene::{Nodes, Scene};
use super::setup_error::SetupError;
use crate::flow::MetricRole;
use crate::geometry::shapes::{ByArcLength, Resampled};
use crate::geometry::{Closure, Grading, GradingError, Layout, PeriodicGrid, SpectralLayout};

/// The initial curve on its nodes.
pub(super) struct InitialState {
    pub mesh: Mesh,
    pub grading: Option<Arc<Grading>>,
    pub curve: Resampled,
    pub state: Vec<f64>,
    pub closure_defect: f64,
}

/// Largest gap, relative to the length, that is closed on input without complaint.
const LARGEST_GAP: f64 = 1e-2;
/// Nodes on which the initial data are looked at first, and the most that they get: data with kinks need any number, and the
/// flow smooths them.
const FIRST_NODES: usize = 256;
const MOST_FIRST_NODES: usize = 4096;
/// Part that a kink leaves unresolved; more than that is a curve that the nodes miss.
const SMOOTHED: f64 = 1e-2;
/// Part that may be missed between the nodes, in units of what may be left unresolved by the spectrum at hand.
const MISSED: f64 = 10.0;

impl InitialState {
    /// That of `scene`, whose curve is `curve`, and the part of the data that its nodes miss.
    pub fn of(scene: &Scene, curve: &ByArcLength, own: &OwnTerms) -> Result<(Self, f64), SetupError> {
        let Nodes::Count(nodes) = scene.accuracy.nodes else { return Self::resolved(scene, curve, own) };
        let found = Self::on(scene, curve, nodes)?;
        let missed = found.missed(scene, curve)?;
        Ok((found, missed))
    }

    /// On as many nodes as the data need.
    fn resolved(scene: &Scene, curve: &ByArcLength, own: &OwnTerms) -> Result<(Self, f64), SetupError> {
        let length = curve.length();
        let too_many = |needed: f64, remedy| SetupError::TooManyNodes { needed, most: MOST_NODES, remedy };
        let fronts = resolution::fronts(scene, length);
        if scene.flow.gauge.metric() != MetricRole::Graded && fronts > MOST_NODES as f64 {
            let remedy =
                "make epsilon or delta larger, let nodes follow the fronts (flow.gauge = \"graded\")";
            return Err(too_many(fronts, remedy));
        }
        let least = length / largest_spacing(scene, length, own)?;
        if least > MOST_NODES as f64 {
            return Err(too_many(least, "make the kernel of adhesion wider, take a looser tolerance"));
        }
        let (mut nodes, family, aim) = (FIRST_NODES, family(scene, false), unresolved_bound(scene));
        let smoother = match family.order() {
            None => "smooth the curve, take a looser tolerance",
            Some(_) => "take the derivative \"auto\", a looser tolerance",
        };
        loop {
            match Self::on(scene, curve, nodes) {
                Ok(look) => {
                    let layout = layout(scene, nodes);
                    let needed = needed_nodes(layout, &look.state, aim, family).max(size_above(least));
                    let smooths = unresolved(layout, &look.state, nodes, family) < SMOOTHED;
                    let kinks = needed > nodes && nodes >= MOST_FIRST_NODES && smooths;
                    if needed > nodes && !kinks {
                        nodes = needed;
                    } else {
                        let fewer = needed.max(resolution::LEAST_NODES);
                        let found = if fewer < nodes { Self::on(scene, curve, fewer)? } else { look };
                        let missed = found.missed(scene, curve)?;
                        if kinks || missed <= MISSED * aim {
                            return Ok((found, missed));
                        }
                        nodes *= 2; // what is missed looked like longer waves
                    }
                    if nodes > MOST_NODES {
                        return Err(too_many(nodes as f64, smoother));
                    }
                }
                // Nodes that miss a lobe count its turns wrongly.
                Err(SetupError::TurningNumber { .. }) if nodes < MOST_FIRST_NODES => nodes *= 2,
                Err(error) if nodes >= MOST_NODES => return Err(error),
                Err(
                    SetupError::TooFewNodes { .. } | SetupError::Grading(GradingError::NotResolved { .. }),
                ) => {
                    nodes *= 2;
                }
                Err(error) => return Err(error),
            }
        }
    }

    fn on(scene: &Scene, curve: &ByArcLength, nodes: usize) -> Result<Self, SetupError> {
        let mesh = Mesh::of(nodes);
        let grading = mesh.grading(scene)?;
        let curve = match &grading {
            None => curve.resample(nodes)?,
            Some(grading) => curve.resample_graded(grading)?,
        };
        check_turning(scene, &curve)?;
        let (state, closure_defect) = initial_state(scene, &curve, layout(scene, nodes), grading.as_ref())?;
        Ok(Self { mesh, grading, curve, state, closure_defect })
    }

    fn missed(&self, scene: &Scene, curve: &ByArcLength) -> Result<f64, SetupError> {
        Ok(missed(scene, curve, layout(scene, self.mesh.nodes), &self.state, self.grading.as_deref())?)
    }
}

/// Largest distance of nodes that the energies of positions allow on the initial curve.
fn largest_spacing(scene: &Scene, length: f64, own: &OwnTerms) -> Result<f64, SetupError> {
    let terms =
        energy_terms(scene, &Initial { length, area: 0.0, is_round: false, own: own.clone() }, FIRST_NODES)?;
    let error = unresolved_bound(scene);
    Ok(terms.iter().map(|term| term.largest_spacing(length, error)).fold(f64::INFINITY, f64::min))
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
    let places = if scene.curve.points().is_some() { &curve.parameter } else { &fractions };
    let mut densities = Vec::new();
    for density in &scene.density {
        let values = density.initial.values(&fractions, places);
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
