//! The nodes that crowd where a state varies on small scales. See `THEORY.md`, eq. (D13).

use std::sync::Arc;

use super::{Adaptation, Plan, Way, sparsest};
use crate::flow::{Regrading, local_wave_numbers};
use crate::geometry::{Grading, Layout, follow_scales};
use crate::run::membrane::Membrane;
use crate::run::mesh::Mesh;
use crate::run::resolution::{LEAST_NODES, MOST_NODES, size_above, unresolved};

/// Ratio of the numbers of nodes that are tried.
const NEXT: f64 = 1.2;
/// More nodes at a time than this factor are a guess.
const MOST_GROWTH: usize = 2;
/// What a spectrum says of fewer nodes holds within this factor: they would crowd a little differently.
const FORETOLD: f64 = 2.0;
/// A grading that spreads less than this is not worth its products.
const LEAST_SPREAD: f64 = 2.0;

/// Nodes that were tried.
struct Trial {
    /// Part of the state that they leave unresolved.
    part: f64,
    /// The next fewer ones, and what they would leave as far as the spectrum on these tells.
    fewer: Option<(usize, f64)>,
    plan: Plan,
}

impl Adaptation {
    /// The fewest nodes found, near `nodes` of them, on which only the part `aim` of the spectral `state` of `membrane` is not
    /// resolved, with that part; as many `equidistant` ones are needed in any case.
    pub(super) fn crowds(
        &self,
        membrane: &mut Membrane,
        state: &[f64],
        nodes: usize,
        aim: f64,
        equidistant: f64,
    ) -> Option<(f64, Plan)> {
        let turning_number = membrane.turning_number();
        let flow = membrane.flow();
        flow.set_current(state);
        let waves = local_wave_numbers(flow);
        let uniform = || (0..nodes).map(|i| i as f64 / nodes as f64).collect();
        let fractions = flow.current().grading().map_or_else(uniform, Grading::fractions);
        let densities = flow.layout().densities();
        // A trial is a regrading of this state alone, and what is not resolved of it is measured.
        let mut attempt = |nodes: usize| {
            let samples = follow_scales(&fractions, &waves, nodes);
            let spread = is_spread(&samples);
            let grading = if spread { Some(Arc::new(Grading::new(&samples).ok()?)) } else { None };
            let layout = Layout::new(nodes, densities);
            let mut way = Regrading::new(flow, layout, grading.clone(), turning_number);
            let trial = way.apply(flow, state).ok()?;
            let part_on = |nodes| unresolved(layout, &trial, nodes, self.families[usize::from(spread)]);
            let too_few = (nodes as f64) < equidistant * sparsest(grading.as_ref());
            let part = if too_few { f64::INFINITY } else { part_on(nodes) };
            let fewer = fewer(nodes).filter(|_| self.counts).map(|fewer| (fewer, part_on(fewer)));
            let mesh = Mesh { nodes, samples: spread.then_some(samples) };
            let plan = Plan { mesh, way: Way::Regraded(grading, Box::new(way)) };
            Some(Trial { part, fewer, plan })
        };
        let mut best = attempt(nodes)?;
        let most = MOST_NODES.min(MOST_GROWTH * nodes);
        if self.counts && best.part > aim {
            while best.part > aim && best.plan.mesh.nodes < most {
                best = attempt(size_above(NEXT * best.plan.mesh.nodes as f64))?;
            }
        } else if self.counts {
            while let Some((nodes, foretold)) = best.fewer
                && foretold <= FORETOLD * aim
            {
                match attempt(nodes) {
                    Some(fewer) if fewer.part <= aim => best = fewer,
                    _ => break,
                }
            }
        }
        Some((best.part, best.plan))
    }
}

/// The number of nodes below `nodes` that is tried next; none below the least.
fn fewer(nodes: usize) -> Option<usize> {
    // Above the ratio there may be no other size than `nodes` itself.
    let fewer = [NEXT.powi(2), 2.0].map(|ratio| size_above(nodes as f64 / ratio).max(LEAST_NODES));
    fewer.into_iter().find(|fewer| *fewer < nodes)
}

/// Whether a grading differs enough from the uniform one.
fn is_spread(samples: &[f64]) -> bool {
    let least = samples.iter().copied().fold(f64::INFINITY, f64::min);
    samples.iter().any(|w| *w > LEAST_SPREAD * least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_nodes_are_tried_down_to_the_least() {
        let tried: Vec<usize> = std::iter::successors(Some(MOST_NODES), |nodes| fewer(*nodes)).collect();
        assert!(tried.windows(2).all(|pair| pair[1] < pair[0] && 3 * pair[1] >= pair[0]), "{tried:?}");
        assert_eq!(tried.last(), Some(&LEAST_NODES));
        assert_eq!(fewer(48), Some(LEAST_NODES));
    }
}
