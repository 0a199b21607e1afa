//! Banded approximate inverses of I − γJ: [`local`] for nodes at fixed fractions of the length, [`material`] for nodes that move
//! with the curve, or count so. See `THEORY.md`, eqs. (O2) and (O9).

mod all_modes;
mod coefficients;
mod compact_laplacian;
mod local;
mod local_spacing;
mod material;
mod reach;
mod window;

use std::fmt::Debug;

use all_modes::AllModes;
use coefficients::Coefficients;
use local::LocalPart;
use material::MaterialPart;
use reach::{diffuses, most_at_first};
pub use reach::{exists, leaves_modes};
use window::Window;

use crate::flow::gradient_flow::GradientFlow;
use crate::geometry::Complex64;
use crate::operators::FactorisationError;

/// A banded approximate inverse acting on spectra.
pub trait Banded: Debug + Send + Sync {
    /// Number of modes treated.
    fn modes(&self) -> usize;
    /// Factorises at the frozen state.
    fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError>;
    /// Applies the inverse to the low modes of all fields.
    fn apply(&mut self, spectra: &mut [Complex64]);
}

/// Builds the solver for the number of fields, up to four; for the normal velocity if it is `of_velocity`, as it always is on nodes that
/// move with the curve; for all modes if it `holds_all`. None for more fields, and none on a handful of nodes.
pub fn build(flow: &GradientFlow, of_velocity: bool, holds_all: bool) -> Option<Box<dyn Banded>> {
    if of_velocity || flow.layout().metric().is_some() {
        return on_nodes(flow, None);
    }
    let low = on_nodes(flow, Some(most_at_first(flow)));
    if !holds_all || !leaves_modes(flow) {
        return low;
    }
    let both = low.zip(on_nodes(flow, Some(usize::MAX)));
    both.map(|(low, all)| Box::new(AllModes::new(low, all)) as Box<dyn Banded>)
}

/// That of the curvature on at most so many equidistant nodes, or that of the normal velocity.
fn on_nodes(flow: &GradientFlow, most: Option<usize>) -> Option<Box<dyn Banded>> {
    if !exists(flow) {
        return None;
    }
    match (flow.layout().fields(), diffuses(flow)) {
        (1, false) => Some(of_fields::<1, 3>(flow, most)),
        (2, false) => Some(of_fields::<2, 7>(flow, most)),
        (3, false) => Some(of_fields::<3, 11>(flow, most)),
        (4, false) => Some(of_fields::<4, 15>(flow, most)),
        (1, true) => Some(of_fields::<1, 4>(flow, most)),
        (2, true) => Some(of_fields::<2, 9>(flow, most)),
        (3, true) => Some(of_fields::<3, 14>(flow, most)),
        (4, true) => Some(of_fields::<4, 19>(flow, most)),
        _ => None,
    }
}

/// That of `F` fields, with a band of half-width `B`.
fn of_fields<const F: usize, const B: usize>(flow: &GradientFlow, most: Option<usize>) -> Box<dyn Banded> {
    match most {
        Some(most) => Box::new(LocalPart::<F, B>::new(flow, most)),
        None => Box::new(MaterialPart::<F, B>::new(flow)),
    }
}

/// That of the curvature alone, where one [`exists`]; what the densities at hand make concave is left out. On graded nodes the
/// highest modes of surface diffusion are too far from the band's.
pub fn of_curvature(flow: &GradientFlow) -> Option<Box<dyn Banded>> {
    let serves = exists(flow) && flow.layout().metric().is_none() && !diffuses(flow);
    serves.then(|| Box::new(LocalPart::<1, 3>::convex(flow)) as Box<dyn Banded>)
}
