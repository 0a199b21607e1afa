//! The flows that have a band.

use crate::flow::gradient_flow::GradientFlow;

/// Graded and co-moving nodes are crowded somewhere: fewer of them would miss what they crowd for.
pub const MOST_UNEQUAL_NODES: usize = 8192;
/// F fields have a band of half-width 4F − 1, which needs three times as many rows: 12 nodes for any F. With surface diffusion it is
/// 5F − 1.
const FEWEST_NODES: usize = 12;
const FEWEST_NODES_OF_SURFACE_DIFFUSION: usize = 15;
/// Most fields of the bands that are compiled.
const MOST_FIELDS: usize = 4;

/// Whether there is a band for `flow`.
pub fn exists(flow: &GradientFlow) -> bool {
    let layout = flow.layout();
    let fewest = if diffuses(flow) { FEWEST_NODES_OF_SURFACE_DIFFUSION } else { FEWEST_NODES };
    layout.nodes() >= fewest && layout.fields() <= MOST_FIELDS
}

/// Whether the normal mobility is that of surface diffusion, which widens the band.
pub fn diffuses(flow: &GradientFlow) -> bool {
    flow.normal_mobility().is_minus_laplacian()
}
