//! Decides when a run goes on with other nodes: more where the solution asks for them, fewer where it allows. See
//! `THEORY.md`, eqs. (D11) and (D12).

use std::sync::Arc;

use super::membrane::Membrane;
use super::mesh::Mesh;
use super::resolution::{LEAST_NODES, MOST_NODES, needed_nodes, size_above, unresolved};
use super::scene::{Gauge, Nodes, Scene};
use super::setup::family;
use crate::flow::{Regrading, local_wave_numbers};
use crate::geometry::{Grading, Layout, follow_scales, resample};
use crate::operators::DerivativeFamily;

/// Steps on the same nodes before the first look at whether fewer would do; then after twice as many, and so on.
const FIRST_LOOK: u64 = 8;
/// Part of the bound that fewer nodes must meet, and that new ones must where those at hand do not serve.
const MARGIN_OF_FEWER: f64 = 0.3;
const MARGIN_OF_MORE: f64 = 0.6;
/// Fewer nodes must save this part of them.
const WORTHWHILE: f64 = 0.7;
const LEFT_OUT: f64 = 2.0;
const MOST_LEFT_OUT: f64 = 3e-4;
/// Ratio of the numbers of nodes that are tried.
const NEXT: f64 = 1.2;
/// A grading that spreads less than this is not worth its products.
const LEAST_SPREAD: f64 = 2.0;
/// A new grading of as many nodes must lower what is not resolved by this factor.
const BETTER: f64 = 0.3;

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
}

/// The nodes that a run goes on with.
#[derive(Clone, Debug)]
pub struct Plan {
    pub mesh: Mesh,
    /// Their grading, if it is a new one; otherwise the parameter s of each point of the curve stays.
    pub regraded: Option<Option<Arc<Grading>>>,
}

impl Adaptation {
    /// For `scene`; none if it leaves nothing to the program.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        let counts = scene.accuracy.nodes == Nodes::Auto;
        let grades = scene.flow.gauge == Gauge::Graded && scene.flow.grading.is_none();
        (counts || grades).then(|| Self {
            bound: unresolved_bound(scene.accuracy.tolerance),
            counts,
            grades,
            families: [false, true].map(|graded| family(scene, graded)),
        })
    }

    /// Whether the grading is chosen.
    #[must_use]
    pub fn grades(&self) -> bool {
        self.grades
    }

    /// Other nodes for the spectral `state` of `membrane` after `steps` steps, `age` of them on these nodes; none if these
    /// serve.
    pub fn plan(&self, membrane: &mut Membrane, state: &[f64], mesh: &Mesh, age: u64) -> Option<Plan> {
        let layout = membrane.layout();
        let family = self.families[usize::from(membrane.flow().grading().is_some())];
        let part = unresolved(layout, state, layout.nodes(), family);
        let resolved = part <= self.bound;
        if resolved && !(age >= FIRST_LOOK && age.is_power_of_two()) {
            return None;
        }
        let aim = self.bound * if resolved { MARGIN_OF_FEWER } else { MARGIN_OF_MORE };
        let same = self.count(layout, state, mesh, aim, family);
        let regraded = if self.grades { self.regrade(membrane, state, mesh, aim) } else { None };
        let nodes = mesh.nodes as f64;
        if let Some((needed, rest, plan)) = regraded {
            let fewer = (needed as f64) < WORTHWHILE * (same.min(mesh.nodes)) as f64;
            let better = rest < BETTER * part && part > BETTER * self.bound;
            let serves = !resolved && self.counts && needed <= same;
            if fewer || serves || (!self.counts && better) {
                return Some(plan);
            }
        }
        let worth = (same as f64) < WORTHWHILE * nodes || (!resolved && same > mesh.nodes);
        (self.counts && worth).then(|| Plan { mesh: Self::with_nodes(mesh, same), regraded: None })
    }

    /// Nodes needed in the same parameter.
    fn count(&self, layout: Layout, state: &[f64], mesh: &Mesh, aim: f64, family: DerivativeFamily) -> usize {
        if !self.counts {
            return mesh.nodes;
        }
        needed_nodes(layout, state, aim, family).clamp(LEAST_NODES, MOST_NODES)
    }

    /// The best grading for `state`: how many nodes it needs, what they leave unresolved, and the plan.
    fn regrade(
        &self,
        membrane: &mut Membrane,
        state: &[f64],
        mesh: &Mesh,
        aim: f64,
    ) -> Option<(usize, f64, Plan)> {
        let flow = membrane.flow();
        flow.set_current(state);
        let waves = local_wave_numbers(flow);
        let uniform = || (0..mesh.nodes).map(|i| i as f64 / mesh.nodes as f64).collect();
        let fractions = flow.current().grading().map_or_else(uniform, Grading::fractions);
        let graded = |nodes: usize| {
            let samples = follow_scales(&fractions, &waves, nodes);
            let (low, high) = extremes(&samples);
            let spread = high > LEAST_SPREAD * low;
            let grading = if spread { Some(Arc::new(Grading::new(&samples).ok()?)) } else { None };
            Some((spread.then_some(samples), grading))
        };
        let turning_number = membrane.turning_number();
        let densities = membrane.layout().densities();
        let flow = membrane.flow();
        let mut attempt = |nodes: usize| {
            let (samples, grading) = graded(nodes)?;
            let family = self.families[usize::from(grading.is_some())];
            let layout = Layout::new(nodes, densities);
            let trial = Regrading::new(flow, layout, grading.clone(), turning_number).apply(flow, state).ok()?;
            let rest = unresolved(layout, &trial, nodes, family);
            Some((nodes, rest, Plan { mesh: Mesh { nodes, samples }, regraded: Some(grading) }))
        };
        let mut best = attempt(mesh.nodes)?;
        while self.counts && best.1 > aim && best.0 < 2 * mesh.nodes && best.0 < MOST_NODES {
            best = attempt(size_above(NEXT * best.0 as f64))?;
        }
        while self.counts && best.1 <= aim && best.0 > LEAST_NODES {
            match attempt(size_above(best.0 as f64 / NEXT / NEXT)) {
                Some(fewer) if fewer.1 <= aim => best = fewer,
                _ => break,
            }
        }
        Some(best)
    }

    /// As many nodes in the same parameter.
    fn with_nodes( mesh: &Mesh, nodes: usize) -> Mesh {
        let samples = mesh.samples.as_ref().map(|samples| resample(samples, Grading::samples(nodes)));
        Mesh { nodes, samples }
    }
}

/// Least and largest value.
fn extremes(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// Part of a state that may be left unresolved for errors of about the tolerance: measured, see `benches/README.md`. At loose
/// tolerances fronts that are hardly resolved are held by the nodes, and that error is far larger than what is not resolved.
pub(super) fn unresolved_bound(tolerance: f64) -> f64 {
    (LEFT_OUT * tolerance).clamp(1e-13, MOST_LEFT_OUT)
}
