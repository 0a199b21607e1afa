//! The flow map A, its transpose and the mobility 𝓚.

use flow_core::flow::{CurveFields, FlowMap};
use flow_core::geometry::{Complex64, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};
use proptest::prelude::*;

use crate::config;
use crate::states::{any_blob, any_nodes, spectral};
use crate::terms::{Term, every_flow, flow};
use crate::vectors::{distance, largest, motion, noise, pair, size};

/// Rounding of chains of up to six transforms, relative to the norms of the factors (Cauchy–Schwarz).
const ROUNDING: f64 = 1e-12;

/// The composition goes through nodal values, whose rounding the mobility magnifies by up to (πn/|Γ|)⁴ = 5e6 where
/// the result itself is smooth (measured: 4e-12).
const DETOUR: f64 = 1e-10;

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn the_force_is_minus_the_transpose_of_the_rates(
        blob in any_blob(), nodes in any_nodes(), densities in 0_usize..3, seed: u64,
    ) {
        for family in DerivativeFamily::ALL {
            let state = blob.state(nodes, densities);
            let (layout, length) = (state.layout, state.y[state.layout.length_index()]);
            let mut grid = PeriodicGrid::new(nodes);
            let derivative = Derivative::new(family, &grid);
            let mut map = FlowMap::new(layout, &grid, &derivative);
            let mut at = CurveFields::new(layout, &grid, &derivative);
            at.set(&spectral(layout, &state.y), &mut grid, &derivative);
            let (v, dual) = (noise(seed, nodes), noise(!seed, layout.len()));
            let modes = grid.modes();
            let mut spectra = vec![Complex64::default(); layout.fields() * modes];
            let mut rates = vec![0.0; layout.len()];
            rates[layout.length_index()] = map.rates(&at, &v, &mut spectra);
            for field in 0..layout.fields() {
                let spectrum = &mut spectra[field * modes..(field + 1) * modes];
                grid.synthesise(spectrum, &mut rates[layout.field(field)]);
                grid.transform(&dual[layout.field(field)], spectrum);
            }
            let mut force = vec![0.0; nodes];
            map.force(&at, &spectra, dual[layout.length_index()], &mut force);
            let mean = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / nodes as f64;
            let (left, right) = (pair(layout, &dual, &rates), -length * mean(&force, &v));
            let scale = size(layout, &dual) * size(layout, &rates)
                + length * (mean(&force, &force) * mean(&v, &v)).sqrt();
            prop_assert!(
                (left - right).abs() <= ROUNDING * scale,
                "{family:?}, n = {nodes}: {left} ≠ {right}, scale {scale:.1e}"
            );
        }
    }

    #[test]
    fn the_mobility_is_symmetric_and_not_negative(
        blob in any_blob(), nodes in any_nodes(), densities in 0_usize..3, seed: u64,
    ) {
        for family in DerivativeFamily::ALL {
            let state = blob.state(nodes, densities);
            let layout = state.layout;
            let mut flow = flow(Term::Tension, family, layout);
            flow.linearise(&state.y);
            let (a, b) = (noise(seed, layout.len()), noise(!seed, layout.len()));
            let (mut of_a, mut of_b) = (vec![0.0; a.len()], vec![0.0; a.len()]);
            flow.apply_mobility(&a, &mut of_a);
            flow.apply_mobility(&b, &mut of_b);
            let (left, right) = (pair(layout, &of_a, &b), pair(layout, &of_b, &a));
            let scale = size(layout, &of_a) * size(layout, &b) + size(layout, &of_b) * size(layout, &a);
            prop_assert!((left - right).abs() <= ROUNDING * scale, "{family:?}, n = {nodes}: {left} ≠ {right}");
            let square = pair(layout, &of_a, &a);
            prop_assert!(square >= 0.0, "{family:?}, n = {nodes}: {square}");
        }
    }

    #[test]
    fn the_implicit_operator_is_minus_mobility_times_second_derivative(
        blob in any_blob(), nodes in any_nodes(), seed: u64,
    ) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let mut flow = flow(term, family, state.layout);
            flow.linearise(&state.y);
            let v = motion(state.layout, seed);
            let [mut hessian, mut product, mut expected] = [(); 3].map(|()| vec![0.0; v.len()]);
            flow.jacobian_product(&v, &mut product);
            flow.hessian_product(&v, &mut hessian);
            flow.apply_mobility(&hessian, &mut expected);
            let expected: Vec<f64> = expected.iter().map(|value| -value).collect();
            let error = distance(&product, &expected);
            prop_assert!(
                error <= DETOUR * largest(&expected),
                "{term:?}, {family:?}, n = {nodes}: error {error:.1e} of {:.1e}", largest(&expected)
            );
        }
    }

    /// The integrator works on Fourier coefficients; what nodal values cannot hold is out of reach of its solves.
    #[test]
    fn spectral_rates_are_those_of_real_fields(blob in any_blob(), nodes in any_nodes(), seed: u64) {
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let mut flow = flow(term, family, state.layout);
            let (y, v) = (spectral(state.layout, &state.y), spectral(state.layout, &motion(state.layout, seed)));
            let (mut rate, mut product) = (vec![0.0; y.len()], vec![0.0; y.len()]);
            flow.spectral_rate(&y, &mut rate);
            flow.spectral_linearise(&y);
            flow.spectral_jacobian_product(&v, &mut product);
            let form = flow.spectral_layout();
            for vector in [&rate, &product] {
                for spectrum in form.spectra(vector).chunks_exact(form.modes()) {
                    prop_assert_eq!(spectrum[0].im, 0.0);
                    prop_assert!(nodes % 2 == 1 || spectrum[nodes / 2].im == 0.0, "{:?}, {:?}", term, family);
                }
            }
        }
    }
}
