//! The discrete energy law and the conserved sums.

use proptest::prelude::*;

use crate::config;
use crate::states::{any_blob, any_nodes};
use crate::terms::{every_flow, flow};
use crate::vectors::{largest, pair, size};

/// Rounding relative to the dissipation itself: all parts of it are of one sign.
const RELATIVE: f64 = 1e-11;
/// Rounding relative to ‖∇𝓕‖‖rate‖, for states that hardly dissipate.
const ROUNDING: f64 = 1e-14;

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn the_energy_falls_at_the_rate_of_the_dissipation(blob in any_blob(), nodes in any_nodes()) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let layout = state.layout;
            let mut flow = flow(term, family, layout);
            let (mut gradient, mut rate) = (vec![0.0; state.y.len()], vec![0.0; state.y.len()]);
            let energy = flow.gradient_at(&state.y, &mut gradient);
            let told = flow.rate(&state.y, &mut rate);
            let measured = pair(layout, &gradient, &rate);
            let bound = RELATIVE * told.dissipation + ROUNDING * size(layout, &gradient) * size(layout, &rate);
            prop_assert!(
                (measured + told.dissipation).abs() <= bound,
                "{term:?}, {family:?}, n = {nodes}: {measured} ≠ −{}", told.dissipation
            );
            prop_assert!(told.dissipation >= 0.0);
            prop_assert_eq!(told, flow.dissipation_at(&state.y));
            let by_term: f64 = flow.energies_by_term(&state.y).iter().sum();
            prop_assert!((by_term - energy).abs() <= 1e-13 * energy.abs(), "{term:?}: {by_term} ≠ {energy}");
        }
    }

    #[test]
    fn turning_number_and_masses_are_kept_to_rounding(blob in any_blob(), nodes in any_nodes()) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let mut flow = flow(term, family, state.layout);
            let mut rate = vec![0.0; state.y.len()];
            flow.rate(&state.y, &mut rate);
            for field in 0..state.layout.fields() {
                let rate = &rate[state.layout.field(field)];
                let mean = rate.iter().sum::<f64>() / nodes as f64;
                // One unit in the last place of the largest rate: the mean mode is zero in the spectrum.
                prop_assert!(
                    mean.abs() <= 1e-15 * largest(rate),
                    "{term:?}, {family:?}, n = {nodes}: field {field} gains {mean:.1e} of {:.1e}", largest(rate)
                );
            }
        }
    }
}
