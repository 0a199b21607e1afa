//! Decides when a run goes on with other nodes: more where the solution asks for them, fewer where it allows. See
//! `THEORY.md`, eqs. (D12) and (D13).

mod bound;
mod crowds;
mod error;

use std::sync::Arc;

use super::choices::family;
use super::membrane::Membrane;
use super::mesh::Mesh;
use super::resolution::{LEAST_NODES, MOST_NODES, least_resolved, needed_nodes, size_above};
use super::scene::{Nodes, Scene};
use crate::flow::Regrading;
use crate::geometry::{Grading, Layout, SpectralLayout, resample};
use crate::operators::DerivativeFamily;
pub(super) use bound::unresolved_bound;
pub use error::ResolutionError;

/// Steps on the same nodes between looks at whether fewer would do, or other crowds.
const LOOKS: u64 = 4;
/// Where nodes crowd a look is dear: the first one after so many steps, then after twice as many, and so on.
const FIRST_LOOK: u64 = 8;
/// Part of the bound that fewer nodes must meet, where they crowd, and that new ones must where those at hand do not serve.
const MARGIN_OF_FEWER: f64 = 0.3;
const MARGIN_OF_FEWER_IN_CROWDS: f64 = 0.15;
const MARGIN_OF_MORE: f64 = 0.6;
/// Part of the bound beyond which the solution counts as sliding off its crowds, though not too far yet for new ones to find it clean:
/// what it loses once they do not resolve it asks for nodes everywhere, and for steps to go away.
const SLIDING: f64 = 0.5;
/// Factor by which as many nodes must lower what is not resolved then.
const BETTER_THERE: f64 = 0.8;
/// Fewer nodes must save this part of them.
const WORTHWHILE: f64 = 0.7;
/// A new grading of as many nodes must lower what is not resolved by this factor.
const BETTER: f64 = 0.3;

/// Steps that the most nodes get to smooth what they do not resolve: kinks of the initial data.
const PATIENCE: u64 = 32;
/// Part of a field beyond which the most nodes are hopeless then: a jump leaves less than a hundredth of itself unresolved, and runs
/// that sharpen one are not stopped; waves as short as the distance of the nodes leave nearly all.
const HOPELESS: f64 = 0.1;

/// What a scene leaves to the program.
#[derive(Clone, Debug)]
pub struct Adaptation {
    /// Part of a state that may be left unresolved.
    bound: f64,
    /// Whether the number of nodes is free.
    counts: bool,
    /// Whether the grading is.
    grades: bool,
    /// The derivatives on equidistant and on graded nodes.
    families: [DerivativeFamily; 2],
    /// The names of the densities.
    densities: Vec<String>,
}

/// The nodes that a run goes on with.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub mesh: Mesh,
    pub way: Way,
}

/// How a state comes to the nodes of a plan.
#[derive(Clone, Debug)]
pub(super) enum Way {
    /// The parameter s of each point of the curve stays.
    SameParameters,
    /// To other fractions of the arc length: those of a grading, or equal ones.
    Regraded(Option<Arc<Grading>>, Box<Regrading>),
}

/// What a state leaves unresolved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Glance {
    /// The field that is resolved least, and the part of it that is not.
    field: usize,
    part: f64,
    /// Whether the solution slides off its crowds.
    slides: bool,
    /// Steps on the same nodes.
    age: u64,
}

/// What a look at the nodes found.
#[derive(Clone, Debug)]
pub(super) enum Look {
    /// They serve.
    Serve,
    /// Others would be better.
    Change(Plan),
    /// They do not serve, and no others are allowed.
    Unresolved,
    /// The most nodes have long been far from serving.
    Hopeless(ResolutionError),
}

impl Adaptation {
    /// For `scene`; none if it leaves nothing to the program.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        let counts = scene.accuracy.nodes == Nodes::Auto;
        let grades = scene.flow.follows_solution();
        (counts || grades).then(|| Self {
            bound: unresolved_bound(scene),
            counts,
            grades,
            families: [false, true].map(|graded| family(scene, graded)),
            densities: scene.density.iter().map(|density| density.name.clone()).collect(),
        })
    }

    /// Whether the nodes are to be looked at for the spectral `state` of `membrane`, which has been on them for `age` steps: with what
    /// they leave unresolved, if so.
    pub(super) fn glance(&self, membrane: &mut Membrane, state: &[f64], age: u64) -> Option<Glance> {
        let layout = membrane.layout();
        let family = self.family(membrane);
        let (field, part) = least_resolved(layout, state, layout.nodes(), family);
        let resolved = part <= self.bound;
        let slides = self.grades && resolved && part > SLIDING * self.bound;
        let due = if self.grades {
            let soon = age > 1 && (age < FIRST_LOOK || age.is_multiple_of(LOOKS));
            (slides && soon) || (age >= FIRST_LOOK && age.is_power_of_two())
        } else {
            age > 0 && age.is_multiple_of(LOOKS)
        };
        (due || !resolved).then_some(Glance { field, part, slides, age })
    }

    /// Whether other nodes are better for the spectral `state` of `membrane` at `time`, on those of `mesh`, after a `glance`; `room` for a
    /// state.
    pub(super) fn look(
        &self,
        membrane: &mut Membrane,
        (time, state): (f64, &[f64]),
        mesh: &Mesh,
        glance: Glance,
        room: &mut [f64],
    ) -> Look {
        let Glance { field, part, slides, age } = glance;
        let (layout, family) = (membrane.layout(), self.family(membrane));
        let resolved = part <= self.bound;
        let equidistant = self.fewest_equidistant(membrane, state);
        let least = equidistant * sparsest_in(membrane, state, room);
        let resolved = resolved && mesh.nodes as f64 >= least;
        let margin = match (resolved, self.grades) {
            (false, _) => MARGIN_OF_MORE,
            (true, false) => MARGIN_OF_FEWER,
            (true, true) => MARGIN_OF_FEWER_IN_CROWDS,
        };
        let aim = if slides { BETTER_THERE * part } else { self.bound * margin };
        let needed = needed_nodes(layout, state, aim, family).max(size_above(least));
        let same = if self.counts { needed.clamp(LEAST_NODES, MOST_NODES) } else { mesh.nodes };
        let crowds =
            if self.grades { self.crowds(membrane, state, mesh.nodes, aim, equidistant) } else { None };
        let worthwhile = |nodes: usize, than: usize| (nodes as f64) < WORTHWHILE * than as f64;
        if let Some((unresolved, plan)) = crowds {
            let nodes = plan.mesh.nodes;
            let better = unresolved < BETTER * part && part > BETTER * self.bound;
            let serves = !resolved && self.counts && nodes <= same;
            let follows = slides && unresolved <= aim && nodes <= mesh.nodes;
            if serves || follows || worthwhile(nodes, same.min(mesh.nodes)) || (!self.counts && better) {
                return Look::Change(plan);
            }
        }
        if self.counts && (worthwhile(same, mesh.nodes) || (!resolved && same > mesh.nodes)) {
            return Look::Change(Plan { mesh: with_nodes(mesh, same), way: Way::SameParameters });
        }
        if resolved {
            Look::Serve
        } else if self.counts && age >= PATIENCE && part > HOPELESS {
            Look::Hopeless(self.hopeless(time, layout, (field, part)))
        } else {
            Look::Unresolved
        }
    }

    /// The derivatives on the nodes at hand.
    fn family(&self, membrane: &mut Membrane) -> DerivativeFamily {
        self.families[usize::from(membrane.flow().grading().is_some())]
    }

    /// Equidistant nodes that the energies of positions ask for.
    fn fewest_equidistant(&self, membrane: &mut Membrane, state: &[f64]) -> f64 {
        let length = state[SpectralLayout::new(membrane.layout()).length_index()];
        length / membrane.flow().energy_terms().largest_spacing(length, self.bound)
    }

    /// Says that the nodes of `layout` leave `part` of `field` unresolved at `time`.
    #[cold]
    fn hopeless(&self, time: f64, layout: Layout, (field, part): (usize, f64)) -> ResolutionError {
        let nodes = layout.nodes();
        match (field, self.densities.get(field.wrapping_sub(1))) {
            (0, _) => ResolutionError::Curvature { time, nodes, part },
            (_, Some(density)) => ResolutionError::Density { time, nodes, density: density.clone(), part },
            _ => ResolutionError::Metric { time, nodes, part },
        }
    }
}

/// The largest distance of nodes, in that of as many equidistant ones.
fn sparsest(grading: Option<&Arc<Grading>>) -> f64 {
    grading.map_or(1.0, |grading| largest(grading.weight()))
}

/// The same in the spectral `state`, whose metric may be a field; `room` for a state.
pub(super) fn sparsest_in(membrane: &mut Membrane, state: &[f64], room: &mut [f64]) -> f64 {
    let (layout, flow) = (membrane.layout(), membrane.flow());
    let Some(metric) = layout.metric() else { return sparsest(flow.grading()) };
    let spectral = SpectralLayout::new(layout);
    let values = &mut room[..layout.nodes()];
    flow.grid_mut().synthesise(&spectral.spectra(state)[spectral.spectrum(metric)], values);
    largest(values) / state[spectral.length_index()]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The mesh with other nodes at the same parameters.
fn with_nodes(mesh: &Mesh, nodes: usize) -> Mesh {
    let samples = mesh.samples.as_ref().map(|samples| resample(samples, Grading::samples(nodes)));
    Mesh { nodes, samples }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_resolved_is_named() {
        let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "blend").unwrap();
        let adaptation = Adaptation::of(&Scene::parse(text, "blend").unwrap()).unwrap();
        let names = adaptation.densities.clone();
        let layout = Layout::new(64, names.len()).with_metric();
        let error = |field| adaptation.hopeless(0.5, layout, (field, 0.25));
        assert_eq!(error(0), ResolutionError::Curvature { time: 0.5, nodes: 64, part: 0.25 });
        for (index, name) in names.iter().enumerate() {
            let density = name.clone();
            assert_eq!(
                error(1 + index),
                ResolutionError::Density { time: 0.5, nodes: 64, density, part: 0.25 }
            );
        }
        assert_eq!(error(1 + names.len()), ResolutionError::Metric { time: 0.5, nodes: 64, part: 0.25 });
        assert!(names.len() > 1);
    }
}
