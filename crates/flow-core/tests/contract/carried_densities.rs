//! The implicit operator of densities that are only carried along, over nodes that slide on the curve.

use flow_core::operators::DerivativeFamily;
use proptest::prelude::*;

use crate::config;
use crate::gauges::every_spacing;
use crate::mobilities::{Density, Normal};
use crate::states::{any_blob, any_nodes, spectral};
use crate::terms::{Term, flow_on};
use crate::vectors::{distance, largest, motion, moved};

/// Rounding of rates that are differences of derivatives of high order.
const ROUNDING: f64 = 1e-9;

proptest! {
    #![proptest_config(config(8))]

    /// A density without a cost does not move the curve: its rate is linear in it, and nothing of that is left to Newton's method. Not so
    /// under surface diffusion, where the operator does without; material nodes carry their densities anyhow.
    #[test]
    fn the_implicit_operator_has_their_transport(blob in any_blob(), nodes in any_nodes(), seed: u64) {
        for normal in Normal::ALL {
            for family in DerivativeFamily::ALL {
                for (grading, state) in every_spacing(&blob, nodes) {
                    let (layout, y) = (state.layout, &state.y);
                    let terms = Term::Bending.build(layout);
                    let mut flow = flow_on(grading.as_ref(), terms, family, layout, normal, &[Density::Carried]);
                    let of_the_density = layout.field(1);
                    let mut v = motion(layout, seed);
                    v.iter_mut().enumerate().for_each(|(i, v)| if !of_the_density.contains(&i) { *v = 0.0 });
                    let rate = |flow: &mut flow_core::flow::GradientFlow, y: &[f64]| {
                        let mut rate = vec![0.0; spectral(layout, y).len()];
                        flow.spectral_rate(&spectral(layout, y), &mut rate);
                        rate
                    };
                    let (before, after) = (rate(&mut flow, y), rate(&mut flow, &moved(y, 1.0, &v)));
                    let measured: Vec<f64> = after.iter().zip(&before).map(|(after, before)| after - before).collect();
                    let mut predicted = vec![0.0; measured.len()];
                    flow.spectral_linearise(&spectral(layout, y));
                    flow.implicit_product(&spectral(layout, &v), &mut predicted);
                    let scale = largest(&before) + largest(&measured);
                    let slides = layout.metric().is_none() && normal != Normal::SurfaceDiffusion;
                    prop_assert_eq!(slides, flow.sliding_frequency() > 0.0);
                    if slides {
                        let error = distance(&measured, &predicted);
                        prop_assert!(error <= ROUNDING * scale, "{normal:?}, {family:?}, n = {nodes}: {error:.1e} of {scale:.1e}");
                    } else {
                        prop_assert!(largest(&predicted) <= ROUNDING * scale, "{normal:?}, {family:?}, n = {nodes}");
                    }
                }
            }
        }
    }
}
