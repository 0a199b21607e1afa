//! What every mobility must satisfy, with every derivative family and energy term.

use std::f64::consts::TAU;

use flow_core::energies::{Bending, EnergyTerm, Length, Local};
use flow_core::expression::Expression;
use flow_core::flow::CurveFields;
use flow_core::geometry::shapes::Shape;
use flow_core::geometry::{Complex64, Layout, PeriodicGrid, SpectralLayout};
use flow_core::operators::{Derivative, DerivativeFamily};
use proptest::prelude::*;

use crate::config;
use crate::mobilities::{Density, Normal};
use crate::states::{any_blob, any_nodes, figure_eight, fixed_blob};
use crate::terms::{Term, flow_under};
use crate::vectors::{distance, largest, motion, moved, noise, pair, size, vector_difference};

/// Rounding of chains of up to eight transforms, relative to the norms of the factors (Cauchy–Schwarz).
const ROUNDING: f64 = 1e-12;
/// As in `dissipation.rs`.
const RELATIVE: f64 = 1e-11;
const OF_THE_NORMS: f64 = 1e-14;
/// As in `flow_map.rs`, with surface diffusion in between.
const DETOUR: f64 = 1e-9;

/// Every normal mobility with every family, numbered.
fn every_mobility() -> impl Iterator<Item = (usize, Normal, DerivativeFamily)> {
    let pairs =
        Normal::ALL.into_iter().flat_map(|normal| DerivativeFamily::ALL.map(|family| (normal, family)));
    pairs.enumerate().map(|(index, (normal, family))| (index, normal, family))
}

proptest! {
    #![proptest_config(config(12))]

    #[test]
    fn mobilities_are_symmetric_and_not_negative(
        blob in any_blob(), nodes in any_nodes(), eight: bool, seed: u64,
    ) {
        let state = if eight { figure_eight(&blob, nodes, 2) } else { blob.state(nodes, 2) };
        let layout = state.layout;
        for (index, normal, family) in every_mobility() {
            for shift in 0..Density::ALL.len() {
                let densities = Density::two(index + shift);
                let mut flow = flow_under(Term::Tension.build(layout), family, layout, normal, &densities);
                flow.linearise(&state.y);
                let (a, b) = (noise(seed, layout.len()), noise(!seed, layout.len()));
                let (mut of_a, mut of_b) = (vec![0.0; a.len()], vec![0.0; a.len()]);
                flow.apply_mobility(&a, &mut of_a);
                flow.apply_mobility(&b, &mut of_b);
                let (left, right) = (pair(layout, &of_a, &b), pair(layout, &of_b, &a));
                let scale = size(layout, &of_a) * size(layout, &b) + size(layout, &of_b) * size(layout, &a);
                prop_assert!(
                    (left - right).abs() <= ROUNDING * scale,
                    "{normal:?}, {densities:?}, {family:?}, n = {nodes}: {left} ≠ {right}, scale {scale:.1e}"
                );
                let square = pair(layout, &of_a, &a);
                prop_assert!(square >= 0.0, "{normal:?}, {densities:?}, {family:?}, n = {nodes}: {square}");
            }
        }
    }

    #[test]
    fn the_energy_falls_at_the_rate_of_the_dissipation_under_every_mobility(
        blob in any_blob(), nodes in any_nodes(),
    ) {
        for term in Term::ALL {
            let state = blob.state(nodes, term.densities());
            let layout = state.layout;
            for (index, normal, family) in every_mobility() {
                let densities = &Density::two(index)[..term.densities()];
                let mut flow = flow_under(term.build(layout), family, layout, normal, densities);
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
                // What holds the area takes away all of a pressure, up to the rounding of the pressure itself.
                let least = -OF_THE_NORMS * (norms + size(layout, &gradient).powi(2));
                prop_assert!(told.dissipation >= least, "{term:?}, {normal:?}, {family:?}");
                prop_assert_eq!(told, flow.dissipation_at(&state.y));
            }
        }
    }

    #[test]
    fn the_implicit_operator_holds_every_mobility(blob in any_blob(), nodes in any_nodes(), seed: u64) {
        for term in Term::ALL {
            let state = blob.state(nodes, term.densities());
            let v = motion(state.layout, seed);
            for (index, normal, family) in every_mobility() {
                let densities = &Density::two(index)[..term.densities()];
                let mut flow = flow_under(term.build(state.layout), family, state.layout, normal, densities);
                flow.linearise(&state.y);
                // Rates elsewhere must not disturb the frozen mobility.
                let [mut hessian, mut product, mut expected] = [(); 3].map(|()| vec![0.0; v.len()]);
                flow.rate(&moved(&state.y, 1e-2, &v), &mut product);
                flow.jacobian_product(&v, &mut product);
                flow.hessian_product(&v, &mut hessian);
                flow.apply_mobility(&hessian, &mut expected);
                let expected: Vec<f64> = expected.iter().map(|value| -value).collect();
                let error = distance(&product, &expected);
                // Of an energy of the area, what holds the area leaves the rounding of its second derivative, as 𝓚 has it.
                let size = largest(&hessian);
                let rounding: Vec<f64> = noise(seed, v.len()).iter().map(|value| f64::EPSILON * size * value).collect();
                flow.apply_mobility(&rounding, &mut hessian);
                let rounded = if normal.keeps_area() { 4.0 * largest(&hessian) } else { 0.0 };
                prop_assert!(
                    error <= DETOUR * largest(&expected) + rounded + f64::MIN_POSITIVE,
                    "{term:?}, {normal:?}, {family:?}, n = {nodes}: error {error:.1e} of {:.1e}", largest(&expected)
                );
            }
        }
    }

    #[test]
    fn masses_are_kept_where_the_mobility_says_so(blob in any_blob(), nodes in any_nodes()) {
        let state = blob.state(nodes, 2);
        let layout = state.layout;
        for (index, normal, family) in every_mobility() {
            for shift in 0..4 {
                let densities = Density::two(index + shift);
                let mut flow = flow_under(Term::Everything.build(layout), family, layout, normal, &densities);
                let mut rate = vec![0.0; state.y.len()];
                flow.rate(&state.y, &mut rate);
                for (field, density) in densities.iter().enumerate() {
                    let rate = &rate[layout.field(field + 1)];
                    let mean = rate.iter().sum::<f64>() / nodes as f64;
                    let kept = mean.abs() <= 1e-15 * largest(rate);
                    prop_assert!(kept == (*density != Density::Exchange), "{densities:?}: {mean:.1e}");
                    prop_assert!(flow.density_mobilities()[field].conserves_mass() == kept);
                }
            }
        }
    }
}

/// A circle at rest: bending against the length penalty, a density at its preferred value. There the gradient is a multiple of
/// that of the turning number, which is linear in the state, so that −𝓚 Hess 𝓕 is the Jacobian.
#[test]
fn the_implicit_operator_is_the_jacobian_at_rest() {
    let nodes = 48;
    let (penalty, radius) = (3.0, 1.1);
    let circle = Shape::Circle { radius };
    let mut state = fixed_blob().state_on(&circle, nodes, 1);
    let length = state.y[state.layout.length_index()];
    state.y[state.layout.field(1)].fill(0.5 * length);
    let target = length - 0.7 * 0.5 / (penalty * radius * radius);
    let text = "0.5*(protein - 0.5)^2 + 0.1*protein_sigma^2 + 0.2*kappa*(protein - 0.5)^2";
    let expression = Expression::parse(text, &["kappa", "protein", "kappa_sigma", "protein_sigma"]).unwrap();
    let terms = || -> Vec<Box<dyn EnergyTerm>> {
        vec![
            Box::new(Bending::new(0.7)),
            Box::new(Length::Penalty { penalty, target }),
            Box::new(Local::new(&expression, 2, nodes).unwrap()),
        ]
    };
    let v = motion(state.layout, 5);
    for (index, normal, family) in every_mobility() {
        // On a circle the direction 𝓘1 is not defined, and length and area fix it: no motion is left to compare.
        if normal == Normal::IncompressibleAreaPreserving {
            continue;
        }
        let densities = [Density::ALL[index % 4]];
        let mut flow = flow_under(terms(), family, state.layout, normal, &densities);
        let [mut rate, mut product] = [(); 2].map(|()| vec![0.0; v.len()]);
        flow.linearise(&state.y);
        flow.jacobian_product(&v, &mut product);
        flow.rate(&state.y, &mut rate);
        assert!(
            largest(&rate) < 1e-12 * largest(&product),
            "{normal:?}, {family:?}: at rest? {:.1e}",
            largest(&rate)
        );
        let measured = vector_difference(|step| {
            flow.rate(&moved(&state.y, step, &v), &mut rate);
            rate.clone()
        });
        let error = distance(&measured, &product) / largest(&product);
        assert!(error < 1e-6, "{normal:?}, {densities:?}, {family:?}: {error:.1e}");
    }
}

/// A curve of which no more than the length is known.
fn curve_of(length: f64, grid: &mut PeriodicGrid, derivative: &Derivative) -> CurveFields {
    let layout = Layout::new(grid.nodes(), 0);
    let mut at = CurveFields::new(layout, grid, derivative);
    let mut state = vec![0.0; SpectralLayout::new(layout).len()];
    state[SpectralLayout::new(layout).length_index()] = length;
    at.set(&state, grid, derivative);
    at
}

#[test]
fn a_constant_weight_is_plain_diffusion() {
    use flow_core::flow::{DensityMobility, Diffusion, WeightedDiffusion};
    use flow_core::geometry::{Complex64, PeriodicGrid};
    use flow_core::operators::Derivative;
    for nodes in [32, 45] {
        for family in DerivativeFamily::ALL {
            let mut grid = PeriodicGrid::new(nodes);
            let derivative = Derivative::new(family, &grid);
            let mut potential = vec![Complex64::default(); grid.modes()];
            grid.transform(&noise(7, nodes), &mut potential);
            let (mut plain, mut weighted) = (potential.clone(), potential.clone());
            let at = curve_of(1.7, &mut grid, &derivative);
            Diffusion::new(&grid, &derivative).apply(&at, &potential, &mut plain);
            WeightedDiffusion::new(&grid, &derivative, vec![2.0; nodes]).apply(
                &at,
                &potential,
                &mut weighted,
            );
            let error = plain.iter().zip(&weighted).fold(0.0, |e: f64, (a, b)| e.max((2.0 * a - b).norm()));
            let scale = plain.iter().fold(0.0, |e: f64, a| e.max(a.norm()));
            assert!(error < 1e-13 * scale, "{family:?}, n = {nodes}: {error:.1e} of {scale:.1e}");
        }
    }
}

/// −∂_s(w ∂_sμ)/L² of smooth functions, to the order of the family.
#[test]
fn weighted_diffusion_converges_at_the_order_of_the_family() {
    use std::f64::consts::TAU;

    use flow_core::flow::{DensityMobility, WeightedDiffusion};
    use flow_core::geometry::{Complex64, PeriodicGrid};
    use flow_core::operators::Derivative;
    let length = 3.0;
    let error = |family, nodes: usize| {
        let mut grid = PeriodicGrid::new(nodes);
        let derivative = Derivative::new(family, &grid);
        let points = WeightedDiffusion::flux_points(&grid, &derivative);
        let weight = points.iter().map(|s| 1.0 + 0.5 * (TAU * s).sin()).collect();
        let mut mobility = WeightedDiffusion::new(&grid, &derivative, weight);
        let at = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..nodes).map(|i| f(TAU * i as f64 / nodes as f64)).collect()
        };
        let mut potential = vec![Complex64::default(); grid.modes()];
        grid.transform(&at(&|x| (2.0 * x).cos()), &mut potential);
        let mut image = potential.clone();
        mobility.apply(&curve_of(length, &mut grid, &derivative), &potential, &mut image);
        let mut values = vec![0.0; nodes];
        grid.synthesise(&image, &mut values);
        // w μ′ = −2(1 + ½ sin x) sin 2x.
        let exact = at(&|x: f64| {
            let divergence = x.cos() * (2.0 * x).sin() + 4.0 * (1.0 + 0.5 * x.sin()) * (2.0 * x).cos();
            divergence * (TAU / length).powi(2)
        });
        distance(&values, &exact) / largest(&exact)
    };
    for family in DerivativeFamily::ALL {
        let (coarse, fine) = (error(family, 40), error(family, 80));
        match family.order() {
            None => assert!(fine < 1e-13, "{fine:.1e}"),
            Some(order) => {
                let measured = (coarse / fine).log2();
                assert!((measured - f64::from(order)).abs() < 0.3, "{family:?}: order {measured:.2}");
            }
        }
    }
}

/// The band of the preconditioner is made of it; a weight in the wrong place made a run ten times as long.
#[test]
fn three_points_come_near_the_mobility_of_a_density() {
    let (nodes, length) = (512, 3.0);
    let mut grid = PeriodicGrid::new(nodes);
    let wave =
        |i: usize| (TAU * i as f64 / nodes as f64).sin() + 0.5 * (2.0 * TAU * i as f64 / nodes as f64).cos();
    let potential: Vec<f64> = (0..nodes).map(wave).collect();
    let mut spectra = [vec![Complex64::default(); grid.modes()], vec![Complex64::default(); grid.modes()]];
    let [spectrum, image] = &mut spectra;
    grid.transform(&potential, spectrum);
    let mut exact = vec![0.0; nodes];
    for (density, family) in
        Density::ALL.into_iter().flat_map(|density| DerivativeFamily::ALL.map(|family| (density, family)))
    {
        let derivative = Derivative::new(family, &grid);
        let at = curve_of(length, &mut grid, &derivative);
        let mut mobility = density.build(&grid, &derivative);
        mobility.apply(&at, spectrum, image);
        grid.synthesise(image, &mut exact);
        let error = |node: usize| {
            let [left, own, right] = mobility.three_points(&at, node, nodes);
            let of = |place: usize| potential[place % nodes];
            left * of(node + nodes - 1) + own * of(node) + right * of(node + 1) - exact[node]
        };
        let worst = (0..nodes).map(|node| error(node).abs()).fold(0.0, f64::max);
        assert!(worst <= 1e-3 * largest(&exact), "{density:?}, {family:?}: {worst:.1e}");
    }
}
