//! The initial state: on as many nodes as the scene says, or as its curve and densities need.

use std::sync::Arc;

use super::adaptation::unresolved_bound;
use super::assembly::layout;
use super::choices::family;
use super::energy_terms::{Initial, energy_terms};
use super::mesh::Mesh;
use super::missed::missed;
use super::own_terms::OwnTerms;
use super::resolution::{self, MOST_NODES, least_resolved, needed_nodes, size_above};
use super::scene::{DensityMobility, Nodes, Scene};
use super::setup_error::SetupError;
use crate::energies::EnergyTerm;
use crate::flow::MetricRole;
use crate::geometry::shapes::{ByArcLength, Resampled};
use crate::geometry::{Closure, Grading, GradingError, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::DerivativeFamily;

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
/// Nodes on which the initial data are looked at first, and those that data with kinks get, which need any number: the flow smooths them.
const FIRST_NODES: usize = 256;
const NODES_OF_KINKS: usize = 4096;
/// Part that a kink leaves unresolved; more than that is a curve that the nodes miss.
const SMOOTHED: f64 = 1e-2;
/// Twice as many nodes lower what is not resolved by this factor at least, unless it is a kink: of the curvature a jump falls by 1.4, a
/// jump of its slope by 2.8.
const FALLS: f64 = 4.0;
/// Data with kinks are looked at on so many times the nodes that they get, and cut down to these: what lies between nodes does not look
/// like long waves then.
const FINER: usize = 4;
/// Part that may be missed between the nodes, in units of what may be left unresolved by the spectrum at hand.
const MISSED: f64 = 10.0;
/// Part of the initial data that nodes may miss, and of the tolerance if that is more, without a word, where the scene fixes their number.
const MISSED_UNTOLD: f64 = 1e-2;
const MISSED_TOLERANCES: f64 = 10.0;

impl InitialState {
    /// That of `scene`, whose curve is `curve`, and whether its nodes miss so much of the data that no step counts as resolved.
    pub fn of(scene: &Scene, curve: &ByArcLength, own: &OwnTerms) -> Result<(Self, bool), SetupError> {
        let Nodes::Count(nodes) = scene.accuracy.nodes else { return Self::resolved(scene, curve, own) };
        let found = Self::on(scene, curve, nodes)?;
        let missed = found.missed(scene, curve)?;
        Ok((found, missed > MISSED_UNTOLD.max(MISSED_TOLERANCES * scene.accuracy.tolerance)))
    }

    /// On as many nodes as the data need.
    fn resolved(scene: &Scene, curve: &ByArcLength, own: &OwnTerms) -> Result<(Self, bool), SetupError> {
        let least = fewest_nodes(scene, curve.length(), own)?;
        let (mut nodes, family, aim) = (FIRST_NODES, family(scene, false), unresolved_bound(scene));
        let smoother = match family.order() {
            None => "smooth the curve, take a looser tolerance",
            Some(_) => "take the derivative \"auto\", a looser tolerance",
        };
        // The first numbers of nodes on which there may be kinks, and what the last ones left.
        let mut kinks: Option<(usize, f64)> = None;
        loop {
            match Self::on(scene, curve, nodes) {
                Ok(look) => {
                    let layout = layout(scene, nodes);
                    let needed = needed_nodes(layout, &look.state, aim, family).max(size_above(least));
                    // What differences miss besides is known on any nodes.
                    let (field, part) = least_resolved(layout, &look.state, nodes, DerivativeFamily::Fourier);
                    if nodes >= NODES_OF_KINKS && part > aim && part < SMOOTHED {
                        let (first, before) = kinks.unwrap_or((nodes, f64::INFINITY));
                        let stays = !is_smoothed(field, scene, curve.length(), own)?;
                        if 2 * nodes > MOST_NODES || (part * FALLS > before && !stays) {
                            return Ok((look.cut(scene, curve, first)?, stays));
                        }
                        kinks = Some((first, part));
                        nodes *= 2;
                    } else if needed > MOST_NODES && nodes >= NODES_OF_KINKS && part <= aim {
                        // So many differences ask for, of data that are nearly kinks; what the flow makes of them may need fewer.
                        let first = kinks.map_or(nodes, |(first, _)| first);
                        return Ok((look.cut(scene, curve, first)?, false));
                    } else if needed > nodes {
                        nodes = needed;
                    } else {
                        let fewer = needed.max(resolution::LEAST_NODES);
                        let found = if fewer < nodes { Self::on(scene, curve, fewer)? } else { look };
                        if found.missed(scene, curve)? <= MISSED * aim {
                            return Ok((found, false));
                        }
                        nodes *= 2; // what is missed looked like longer waves
                    }
                    if nodes > MOST_NODES {
                        return Err(too_many(nodes as f64, smoother));
                    }
                }
                // Nodes that miss a lobe count its turns wrongly.
                Err(SetupError::TurningNumber { .. }) if nodes < NODES_OF_KINKS => nodes *= 2,
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

    /// On `nodes` nodes, with the long waves that the data have on more of them: these, or [`FINER`] times as many.
    fn cut(self, scene: &Scene, curve: &ByArcLength, nodes: usize) -> Result<Self, SetupError> {
        let finer = (FINER * nodes).min(MOST_NODES);
        let finest = if self.mesh.nodes < finer { Self::on(scene, curve, finer)? } else { self };
        let mut found = Self::on(scene, curve, nodes)?;
        let [from, to] = [finest.mesh.nodes, nodes].map(|nodes| layout(scene, nodes));
        found.state = SpectralLayout::new(from).resampled(&finest.state, &SpectralLayout::new(to));
        found.closure_defect = close(&mut found.state, to, &found.curve, found.grading.as_ref())?;
        Ok(found)
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

fn too_many(needed: f64, remedy: &'static str) -> SetupError {
    SetupError::TooManyNodes { needed, most: MOST_NODES, remedy }
}

/// Fewest nodes that the energies of positions allow on a curve of this `length`.
///
/// # Errors
/// [`SetupError::TooManyNodes`] if they, or the fronts that the scene will have, need more than there may be.
fn fewest_nodes(scene: &Scene, length: f64, own: &OwnTerms) -> Result<f64, SetupError> {
    let fronts = resolution::fronts(scene, length);
    if scene.flow.gauge.metric() != MetricRole::Graded && fronts > MOST_NODES as f64 {
        let remedy = "make epsilon or delta larger, let nodes follow the fronts (flow.gauge = \"graded\")";
        return Err(too_many(fronts, remedy));
    }
    let least = length / largest_spacing(scene, length, own)?;
    if least > MOST_NODES as f64 {
        return Err(too_many(least, "make the kernel of adhesion wider, take a looser tolerance"));
    }
    Ok(least)
}

/// Whether the flow of `scene` smooths `field`: a density that is only carried along stays as it is, and one that exchanges does so at each
/// point by itself unless its slopes have a cost.
fn is_smoothed(field: usize, scene: &Scene, length: f64, own: &OwnTerms) -> Result<bool, SetupError> {
    let density = field.checked_sub(1).and_then(|index| scene.density.get(index));
    Ok(match density.map(|density| density.mobility) {
        Some(DensityMobility::Carried) => false,
        Some(DensityMobility::Exchange) => {
            let terms = terms(scene, length, own)?;
            terms.iter().any(|term| term.stiffness(field) != 0.0 || term.has_slope_density())
        }
        Some(DensityMobility::Diffusion) | None => true,
    })
}

/// The terms of the energy on a curve of this `length`, for a few nodes.
fn terms(scene: &Scene, length: f64, own: &OwnTerms) -> Result<Vec<Box<dyn EnergyTerm>>, SetupError> {
    energy_terms(scene, &Initial { length, area: 0.0, is_round: false, own: own.clone() }, FIRST_NODES)
}

/// Largest distance of nodes that the energies of positions allow on the initial curve.
fn largest_spacing(scene: &Scene, length: f64, own: &OwnTerms) -> Result<f64, SetupError> {
    let error = unresolved_bound(scene);
    Ok(terms(scene, length, own)?
        .iter()
        .map(|term| term.largest_spacing(length, error))
        .fold(f64::INFINITY, f64::min))
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
    let gap = close(&mut state, layout, curve, grading)?;
    Ok((state, gap))
}

/// Closes `curve` in its spectral `state`; returns the gap that there was.
fn close(
    state: &mut [f64],
    layout: Layout,
    curve: &Resampled,
    grading: Option<&Arc<Grading>>,
) -> Result<f64, SetupError> {
    let (nodes, spectral) = (layout.nodes(), SpectralLayout::new(layout));
    let turning = &mut spectral.spectra_mut(state)[..spectral.modes()];
    let gap = Closure::graded(nodes, grading.cloned()).project(
        turning,
        curve.length,
        curve.turning_number,
        curve.angle,
    );
    match gap {
        Ok(gap) if gap <= LARGEST_GAP * curve.length => Ok(gap),
        _ => {
            let gap = gap.unwrap_or_else(|error| error.gap);
            Err(SetupError::TooFewNodes { nodes, gap, bound: LARGEST_GAP * curve.length })
        }
    }
}
