//! Gradient and second derivative of the energy.

use proptest::prelude::*;

use crate::config;
use crate::mobilities::{Density, Normal};
use crate::states::{any_blob, any_nodes};
use crate::terms::{every_flow, flow, flow_under};
use crate::vectors::{difference, distance, largest, motion, moved, pair, size, vector_difference};

/// Truncation and rounding of the differences, 1e-12 of the fifth derivative over the first, with room for the
/// narrow potentials of the agents and for slopes of rough modes (measured: up to 1e-9).
const DIFFERENCES: f64 = 1e-8;

/// Rounding of sums of n products whose parts are up to (πn/|Γ|)² times the result.
const ROUNDING: f64 = 1e-12;

proptest! {
    #![proptest_config(config(12))]

    #[test]
    fn the_gradient_is_the_derivative_of_the_energy(blob in any_blob(), nodes in any_nodes(), seed: u64) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let (layout, y) = (state.layout, &state.y);
            let mut flow = flow(term, family, layout);
            let mut gradient = vec![0.0; y.len()];
            let energy = flow.gradient_at(y, &mut gradient);
            let v = motion(layout, seed);
            let predicted = pair(layout, &gradient, &v);
            let measured = difference(|step| flow.energy_at(&moved(y, step, &v)));
            let scale = energy.abs() + size(layout, &gradient) * size(layout, &v);
            prop_assert!(
                (measured - predicted).abs() <= DIFFERENCES * scale,
                "{term:?}, {family:?}, n = {nodes}: {measured} ≠ {predicted}, scale {scale:.1e}"
            );
        }
    }

    #[test]
    fn the_second_derivative_is_the_derivative_of_the_gradient(
        blob in any_blob(), nodes in any_nodes(), seed: u64,
    ) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let (layout, y) = (state.layout, &state.y);
            let mut flow = flow(term, family, layout);
            let v = motion(layout, seed);
            let mut predicted = vec![0.0; y.len()];
            flow.linearise(y);
            flow.hessian_product(&v, &mut predicted);
            let mut gradient = vec![0.0; y.len()];
            let measured = vector_difference(|step| {
                flow.gradient_at(&moved(y, step, &v), &mut gradient);
                gradient.clone()
            });
            let error = distance(&measured, &predicted);
            let scale = largest(&gradient) + largest(&predicted);
            prop_assert!(
                error <= DIFFERENCES * scale,
                "{term:?}, {family:?}, n = {nodes}: error {error:.1e}, scale {scale:.1e}"
            );
        }
    }

    /// What is public says the same, also where a mobility has left an area to hold.
    #[test]
    fn the_check_of_derivatives_passes_every_term(blob in any_blob(), nodes in any_nodes()) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let mut flow = flow_under(term.build(state.layout), family, state.layout, Normal::AreaPreserving, &vec![Density::Diffusion; term.densities()]);
            flow.linearise(&state.y);
            for errors in flow.check_derivatives(&state.y) {
                prop_assert!(errors.are_small(), "{term:?}, {family:?}, n = {nodes}: {errors:?}");
            }
        }
    }

    #[test]
    fn the_second_derivative_is_symmetric(blob in any_blob(), nodes in any_nodes(), seed: u64) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let layout = state.layout;
            let mut flow = flow(term, family, layout);
            let (v, w) = (motion(layout, seed), motion(layout, !seed));
            let (mut of_v, mut of_w) = (vec![0.0; v.len()], vec![0.0; v.len()]);
            flow.linearise(&state.y);
            flow.hessian_product(&v, &mut of_v);
            flow.hessian_product(&w, &mut of_w);
            let (left, right) = (pair(layout, &of_v, &w), pair(layout, &of_w, &v));
            let scale = size(layout, &of_v) * size(layout, &w) + size(layout, &of_w) * size(layout, &v);
            prop_assert!(
                (left - right).abs() <= ROUNDING * scale,
                "{term:?}, {family:?}, n = {nodes}: {left} ≠ {right}, scale {scale:.1e}"
            );
        }
    }

    #[test]
    fn results_do_not_depend_on_what_was_evaluated_before(
        blob in any_blob(), other in any_blob(), nodes in any_nodes(), seed: u64,
    ) {
        for (term, family) in every_flow() {
            let (state, other) = (blob.state(nodes, term.densities()), other.state(nodes, term.densities()));
            let v = motion(state.layout, seed);
            let results = |used_before: bool| {
                let mut flow = flow(term, family, state.layout);
                let mut out = vec![vec![0.0; v.len()]; 5];
                if used_before {
                    flow.linearise(&other.y);
                    flow.hessian_product(&other.y, &mut out[0]);
                    flow.jacobian_product(&other.y, &mut out[0]);
                    flow.rate(&other.y, &mut out[0]);
                }
                flow.rate(&state.y, &mut out[0]);
                flow.gradient_at(&state.y, &mut out[1]);
                flow.linearise(&state.y);
                flow.hessian_product(&v, &mut out[2]);
                flow.jacobian_product(&v, &mut out[3]);
                flow.apply_mobility(&v, &mut out[4]);
                out
            };
            prop_assert!(results(false) == results(true), "{term:?}, {family:?}, n = {nodes}");
        }
    }
}
