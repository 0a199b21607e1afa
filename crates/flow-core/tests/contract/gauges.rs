//! The laws of the discrete structure on graded and on co-moving nodes: every term, family and mobility.

use std::f64::consts::TAU;
use std::sync::Arc;

use flow_core::flow::{CurveFields, FlowMap, GradientFlow};
use flow_core::geometry::{Complex64, Grading, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};
use proptest::prelude::*;

use crate::config;
use crate::mobilities::{Density, Normal, area_rate};
use crate::states::{Blob, State, any_blob, any_nodes, fixed_blob, spectral};
use crate::terms::{Term, every_flow, flow_on};
use crate::vectors::{difference, distance, largest, motion, moved, noise, pair, size, vector_difference};

/// As in the files of the same laws on uniform nodes.
const RELATIVE: f64 = 1e-11;
const ROUNDING: f64 = 1e-12;
const OF_THE_NORMS: f64 = 1e-14;
const DETOUR: f64 = 1e-9;
const DIFFERENCES: f64 = 1e-8;

/// Node distances that vary by a factor of four.
pub fn grading(nodes: usize) -> Grading {
    let weight = |i: usize| {
        let s = TAU * i as f64 / (2 * nodes) as f64;
        (0.5 * (s + 0.4).cos() + 0.2 * (2.0 * s).sin()).exp()
    };
    let samples: Vec<f64> = (0..2 * nodes).map(weight).collect();
    Grading::new(&samples).expect("resolved")
}

/// The flow of `term` on graded nodes, under identity and diffusion.
fn flow(term: Term, family: DerivativeFamily, state: &State, grading: &Grading) -> GradientFlow {
    let densities = vec![Density::Diffusion; term.densities()];
    flow_on(Some(grading), term.build(state.layout), family, state.layout, Normal::Identity, &densities)
}

/// The same nodes with a fixed metric, and with one that is a field.
fn graded(blob: &Blob, nodes: usize, densities: usize, moving: bool) -> (Grading, State) {
    let grading = grading(nodes);
    let state = blob.graded_state(&grading, densities);
    let state = if moving { with_metric(&state, &grading) } else { state };
    (grading, state)
}

/// The state with its metric as a field.
pub fn with_metric(state: &State, grading: &Grading) -> State {
    let layout = state.layout.with_metric();
    let (fields, length) = state.y.split_at(state.layout.length_index());
    let mut y = fields.to_vec();
    y.extend(grading.weight().iter().map(|weight| weight * length[0]));
    y.push(length[0]);
    State { layout, y }
}

/// States with a density on equidistant, graded and material nodes, each with its grading.
pub fn every_spacing(blob: &Blob, nodes: usize) -> [(Option<Grading>, State); 3] {
    let [fixed, material] = [false, true].map(|moving| graded(blob, nodes, 1, moving));
    [(None, blob.state(nodes, 1)), (Some(fixed.0), fixed.1), (Some(material.0), material.1)]
}

/// Every normal mobility with every family, numbered.
fn every_mobility() -> impl Iterator<Item = (usize, Normal, DerivativeFamily)> {
    let pairs =
        Normal::ALL.into_iter().flat_map(|normal| DerivativeFamily::ALL.map(|family| (normal, family)));
    pairs.enumerate().map(|(index, (normal, family))| (index, normal, family))
}

proptest! {
    #![proptest_config(config(12))]

    #[test]
    fn the_gradient_is_the_derivative_of_the_energy(blob in any_blob(), nodes in any_nodes(), seed: u64, moving: bool) {
        for (term, family) in every_flow() {
            let (grading, state) = graded(&blob, nodes, term.densities(), moving);
            let (layout, y) = (state.layout, &state.y);
            let mut flow = flow(term, family, &state, &grading);
            let mut gradient = vec![0.0; y.len()];
            let energy = flow.gradient_at(y, &mut gradient);
            let by_term: f64 = flow.energies_by_term(y).iter().sum();
            prop_assert!((by_term - energy).abs() <= 1e-13 * energy.abs(), "{term:?}: {by_term} ≠ {energy}");
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
    fn the_second_derivative_is_that_of_the_energy_and_symmetric(
        blob in any_blob(), nodes in any_nodes(), seed: u64, moving: bool,
    ) {
        for (term, family) in every_flow() {
            let (grading, state) = graded(&blob, nodes, term.densities(), moving);
            let (layout, y) = (state.layout, &state.y);
            let mut flow = flow(term, family, &state, &grading);
            let (v, w) = (motion(layout, seed), motion(layout, !seed));
            let [mut of_v, mut of_w, mut gradient] = [(); 3].map(|()| vec![0.0; y.len()]);
            flow.linearise(y);
            flow.hessian_product(&v, &mut of_v);
            flow.hessian_product(&w, &mut of_w);
            let (left, right) = (pair(layout, &of_v, &w), pair(layout, &of_w, &v));
            let scale = size(layout, &of_v) * size(layout, &w) + size(layout, &of_w) * size(layout, &v);
            prop_assert!((left - right).abs() <= ROUNDING * scale, "{term:?}, {family:?}: {left} ≠ {right}");
            let measured = vector_difference(|step| {
                flow.gradient_at(&moved(y, step, &v), &mut gradient);
                gradient.clone()
            });
            let error = distance(&measured, &of_v);
            let scale = largest(&gradient) + largest(&of_v);
            prop_assert!(
                error <= DIFFERENCES * scale,
                "{term:?}, {family:?}, n = {nodes}: error {error:.1e}, scale {scale:.1e}"
            );
        }
    }

    #[test]
    fn the_energy_falls_at_the_rate_of_the_dissipation(blob in any_blob(), nodes in any_nodes(), moving: bool) {
        for term in Term::ALL {
            let (grading, state) = graded(&blob, nodes, term.densities(), moving);
            let layout = state.layout;
            for (index, normal, family) in every_mobility() {
                let densities = &Density::two(index)[..term.densities()];
                let mut flow = flow_on(Some(&grading), term.build(layout), family, layout, normal, densities);
                let (mut gradient, mut rate) = (vec![0.0; state.y.len()], vec![0.0; state.y.len()]);
                flow.gradient_at(&state.y, &mut gradient);
                let told = flow.rate(&state.y, &mut rate);
                let measured = pair(layout, &gradient, &rate);
                let norms = size(layout, &gradient) * size(layout, &rate);
                let bound = RELATIVE * told.dissipation + OF_THE_NORMS * norms;
                prop_assert!(
                    (measured + told.dissipation).abs() <= bound,
                    "{term:?}, {normal:?}, {densities:?}, {family:?}, n = {nodes}: {measured} ≠ −{}", told.dissipation
                );
                let least = -OF_THE_NORMS * (norms + size(layout, &gradient).powi(2));
                prop_assert!(told.dissipation >= least, "{term:?}, {normal:?}, {family:?}");
                for field in 0..layout.fields() {
                    let rate = &rate[layout.field(field)];
                    let mean = rate.iter().sum::<f64>() / nodes as f64;
                    let exchanged = field > 0 && densities[field - 1] == Density::Exchange;
                    prop_assert!(
                        exchanged || mean.abs() <= 1e-15 * largest(rate),
                        "{term:?}, {normal:?}, {family:?}: field {field} gains {mean:.1e} of {:.1e}", largest(rate)
                    );
                }
                let keeps = flow.normal_mobility().keeps();
                let area = area_rate(&mut flow);
                let velocity = flow.normal_velocity();
                prop_assert!(
                    !keeps.area || area.abs() <= 1e-12 * largest(velocity).max(largest(flow.normal_force())),
                    "{term:?}, {normal:?}, {family:?}: area at {area:.1e}"
                );
                let kappa = largest(flow.current().at_nodes(0));
                let length = rate[layout.length_index()] / (kappa * state.y[layout.length_index()]);
                prop_assert!(
                    !keeps.length || length.abs() <= 1e-14 * largest(flow.normal_force()),
                    "{term:?}, {normal:?}, {family:?}: length at {length:.1e}"
                );
            }
        }
    }

    #[test]
    fn the_check_of_derivatives_passes_every_term(blob in any_blob(), nodes in any_nodes(), moving: bool) {
        for (term, family) in every_flow() {
            let (grading, state) = graded(&blob, nodes, term.densities(), moving);
            for errors in flow(term, family, &state, &grading).check_derivatives(&state.y) {
                prop_assert!(errors.are_small(), "{term:?}, {family:?}, n = {nodes}, {moving}: {errors:?}");
            }
        }
    }

    #[test]
    fn the_mobility_is_symmetric_and_not_negative(blob in any_blob(), nodes in any_nodes(), seed: u64, moving: bool) {
        let (grading, state) = graded(&blob, nodes, 2, moving);
        let layout = state.layout;
        for (index, normal, family) in every_mobility() {
            let terms = Term::Tension.build(layout);
            let mut flow = flow_on(Some(&grading), terms, family, layout, normal, &Density::two(index));
            flow.linearise(&state.y);
            let (a, b) = (noise(seed, layout.len()), noise(!seed, layout.len()));
            let (mut of_a, mut of_b) = (vec![0.0; a.len()], vec![0.0; a.len()]);
            flow.apply_mobility(&a, &mut of_a);
            flow.apply_mobility(&b, &mut of_b);
            let (left, right) = (pair(layout, &of_a, &b), pair(layout, &of_b, &a));
            let scale = size(layout, &of_a) * size(layout, &b) + size(layout, &of_b) * size(layout, &a);
            prop_assert!((left - right).abs() <= ROUNDING * scale, "{normal:?}, {family:?}: {left} ≠ {right}");
            prop_assert!(pair(layout, &of_a, &a) >= 0.0, "{normal:?}, {family:?}");
        }
    }

    #[test]
    fn the_implicit_operator_is_minus_mobility_times_second_derivative(
        blob in any_blob(), nodes in any_nodes(), seed: u64, moving: bool,
    ) {
        for (term, family) in every_flow() {
            let (grading, state) = graded(&blob, nodes, term.densities(), moving);
            let mut flow = flow(term, family, &state, &grading);
            flow.linearise(&state.y);
            let v = motion(state.layout, seed);
            let [mut hessian, mut product, mut expected] = [(); 3].map(|()| vec![0.0; v.len()]);
            flow.jacobian_product(&v, &mut product);
            flow.hessian_product(&v, &mut hessian);
            flow.apply_mobility(&hessian, &mut expected);
            let error = product.iter().zip(&expected).fold(0.0, |e: f64, (a, b)| e.max((a + b).abs()));
            prop_assert!(error <= DETOUR * largest(&expected), "{term:?}, {family:?}: error {error:.1e}");
        }
    }

    #[test]
    fn the_force_is_minus_the_transpose_of_the_rates(blob in any_blob(), nodes in any_nodes(), seed: u64, moving: bool) {
        for family in DerivativeFamily::ALL {
            let (grading, state) = graded(&blob, nodes, 2, moving);
            let (layout, length) = (state.layout, state.y[state.layout.length_index()]);
            let mut grid = PeriodicGrid::new(nodes);
            let derivative = Derivative::graded(family, &grid, Some(Arc::new(grading.clone())));
            let mut map = FlowMap::new(layout, &grid, &derivative);
            let mut at = CurveFields::new(layout, &grid, &derivative);
            at.set(&spectral(layout, &state.y), &mut grid, &derivative);
            let (v, dual) = (noise(seed, nodes), noise(!seed, layout.len()));
            let modes = grid.modes();
            let mut spectra = vec![Complex64::default(); layout.state_fields() * modes];
            let mut rates = vec![0.0; layout.len()];
            rates[layout.length_index()] = map.rates(&at, &v, &mut spectra);
            for field in 0..layout.state_fields() {
                let spectrum = &mut spectra[field * modes..(field + 1) * modes];
                grid.synthesise(spectrum, &mut rates[layout.field(field)]);
                grid.transform(&dual[layout.field(field)], spectrum);
            }
            let mut force = vec![0.0; nodes];
            map.force(&at, &spectra, dual[layout.length_index()], &mut force);
            let (left, right) = (pair(layout, &dual, &rates), -length * at.mean_of_product(&force, &v));
            let norms = (at.mean_of_product(&force, &force) * at.mean_of_product(&v, &v)).sqrt();
            let scale = size(layout, &dual) * size(layout, &rates) + length * norms;
            prop_assert!((left - right).abs() <= ROUNDING * scale, "{family:?}, n = {nodes}: {left} ≠ {right}");
        }
    }
}

/// A grading of ones is the uniform gauge, for the central families to rounding; that of Fourier has other flux points.
#[test]
fn a_constant_grading_is_the_uniform_gauge() {
    let nodes = 96;
    let ones = Grading::new(&vec![2.0; 2 * nodes]).expect("constant");
    for (term, family) in every_flow().filter(|(_, family)| family.order().is_some()) {
        let state = fixed_blob().state(nodes, term.densities());
        let mut uniform = crate::terms::flow(term, family, state.layout);
        let mut graded = flow(term, family, &state, &ones);
        let (mut a, mut b) = (vec![0.0; state.y.len()], vec![0.0; state.y.len()]);
        let (left, right) = (uniform.rate(&state.y, &mut a), graded.rate(&state.y, &mut b));
        let energy = (left.energy - right.energy).abs();
        assert!(energy <= 1e-13 * left.energy.abs(), "{term:?}, {family:?}: {energy:.1e}");
        let error = distance(&a, &b) / largest(&a);
        assert!(error <= 1e-7, "{term:?}, {family:?}: {error:.1e}");
    }
}

/// Energy and dissipation are those of the uniform gauge, to the order of the family.
#[test]
fn energy_and_dissipation_converge_to_those_of_the_uniform_gauge() {
    let blob = fixed_blob();
    for (index, normal) in Normal::ALL.into_iter().enumerate() {
        for family in DerivativeFamily::ALL {
            let densities = Density::two(index);
            let rate = |graded: bool, nodes: usize| {
                let grading = graded.then(|| grading(nodes));
                let state = match &grading {
                    None => blob.state(nodes, 2),
                    Some(grading) => blob.graded_state(grading, 2),
                };
                let layout = state.layout;
                let terms = Term::Everything.build(layout);
                let mut flow = flow_on(grading.as_ref(), terms, family, layout, normal, &densities);
                flow.dissipation_at(&state.y)
            };
            let exact = rate(false, 768);
            let order = family.order().unwrap_or(8);
            let errors = [96, 192, 384].map(|nodes| {
                let other = rate(true, nodes);
                [other.energy / exact.energy - 1.0, other.dissipation / exact.dissipation - 1.0].map(f64::abs)
            });
            println!("{normal:?}, {densities:?}, {family:?}: {errors:.1?}");
            let reference = rate(true, 768);
            let floor = (reference.dissipation / exact.dissipation - 1.0).abs();
            for kind in 0..2 {
                let bound = 4.0 * 0.5_f64.powi(order) * errors[1][kind] + 2.0 * floor + 1e-7;
                assert!(errors[2][kind] <= bound, "{normal:?}, {family:?}: {errors:?}, floor {floor:.1e}");
            }
        }
    }
}
