//! The flows that have a band.

use crate::flow::gradient_flow::GradientFlow;

/// Graded and co-moving nodes are crowded somewhere: fewer of them would miss what they crowd for.
pub const MOST_UNEQUAL_NODES: usize = 8192;
/// Of the highest modes, equidistant nodes need a band only where the coefficients vary much, by ten and more; else the symbol serves, at
/// less cost.
const MOST_AT_FIRST: usize = 1024;
const MOST_AT_FIRST_OF_SURFACE_DIFFUSION: usize = 384;
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

/// How many nodes the band of `flow` has at most where a band of all modes is not asked for; graded and co-moving nodes have their own.
pub fn most_at_first(flow: &GradientFlow) -> usize {
    if diffuses(flow) { MOST_AT_FIRST_OF_SURFACE_DIFFUSION } else { MOST_AT_FIRST }
}

/// Whether that band leaves modes to the symbol of which one of all modes exists.
pub fn leaves_modes(flow: &GradientFlow) -> bool {
    let equidistant = flow.grading().is_none() && flow.layout().metric().is_none();
    equidistant && exists(flow) && flow.layout().nodes() > most_at_first(flow)
}

/// Whether the normal mobility is that of surface diffusion, which widens the band.
pub fn diffuses(flow: &GradientFlow) -> bool {
    flow.normal_mobility().is_minus_laplacian()
}

/// Whether the band has 𝓑 = Id, which is that of no surface diffusion and holds no curve.
pub fn moves_freely(flow: &GradientFlow) -> bool {
    !diffuses(flow) && !flow.normal_mobility().holds_curve()
}

/// γ in what moves the curve: zero where the normal mobility holds it.
///
/// A solve is exact to its tolerance alone, and what a band that moves such a curve leaves there can take it out of the hold.
pub fn gamma_of_motion(flow: &GradientFlow, gamma: f64) -> f64 {
    if flow.normal_mobility().holds_curve() { 0.0 } else { gamma }
}
