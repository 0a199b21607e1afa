//! The flow of a scene on a given number of nodes.

use std::sync::Arc;

use super::choices::family;
use super::diagnostics::Diagnostics;
use super::energy_terms::{Initial, energy_terms};
use super::mobilities::{density_mobilities, normal_mobility};
use super::scene::Scene;
use super::setup_error::SetupError;
use crate::flow::{EnergySum, FlowMap, GradientFlow, MetricRole};
use crate::geometry::{Grading, Layout, PeriodicGrid};
use crate::operators::Derivative;

/// Shape of the states of a scene on `nodes` nodes.
pub(super) fn layout(scene: &Scene, nodes: usize) -> Layout {
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
    let normal = normal_mobility(scene, initial.is_round, &grid, &derivative);
    let mobilities = density_mobilities(scene, &grid, &derivative)?;
    Ok((GradientFlow::new(map, energy, layout, normal, mobilities), diagnostics))
}
