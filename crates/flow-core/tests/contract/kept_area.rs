//! The area that the grid has, under the mobility that holds it with every piece of the curve.

use flow_core::energies::Area;
use flow_core::operators::DerivativeFamily;
use proptest::prelude::*;

use crate::config;
use crate::gauges::every_spacing;
use crate::mobilities::{Density, Normal};
use crate::states::{any_blob, any_nodes};
use crate::terms::{Term, flow_on};
use crate::vectors::{pair, size};

/// Rounding of a pairing of the derivative of the area, against the size of both sides.
const ROUNDING: f64 = 1e-11;

proptest! {
    #![proptest_config(config(8))]

    /// Not to the order of the derivative only: what is left would change the energy by more than what is dissipated near a rest.
    #[test]
    fn the_flow_does_not_change_it(blob in any_blob(), nodes in any_nodes()) {
        for family in DerivativeFamily::ALL {
            for (grading, state) in every_spacing(&blob, nodes) {
                let (layout, y) = (state.layout, &state.y);
                let normal = Normal::IncompressibleAreaPreserving;
                let flow = |terms| flow_on(grading.as_ref(), terms, family, layout, normal, &[Density::Diffusion]);
                let (mut rate, mut by_area) = (vec![0.0; y.len()], vec![0.0; y.len()]);
                flow(Term::Agents.build(layout)).rate(y, &mut rate);
                flow(vec![Box::new(Area::Pressure(1.0))]).gradient_at(y, &mut by_area);
                let (change, scale) = (pair(layout, &by_area, &rate), size(layout, &by_area) * size(layout, &rate));
                prop_assert!(change.abs() <= ROUNDING * scale, "{family:?}, n = {nodes}: {change:.1e} of {scale:.1e}");
            }
        }
    }
}
