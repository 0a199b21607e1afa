//! The incompressibility operator 𝓘 = Id − κH⁻¹κ, and the mobilities that keep the area.

use std::f64::consts::TAU;

use flow_core::flow::{CurveFields, MobilityError, NormalMobility};
use flow_core::geometry::PeriodicGrid;
use flow_core::geometry::shapes::Shape;
use flow_core::operators::{Derivative, DerivativeFamily};
use proptest::prelude::*;

use crate::config;
use crate::mobilities::{Density, Normal};
use crate::states::{State, any_blob, any_nodes, figure_eight, fixed_blob, spectral};
use crate::terms::{Term, flow_under};
use crate::vectors::{distance, largest, moved, noise};

/// A mobility with the fields of one state.
struct At {
    mobility: Box<dyn NormalMobility>,
    fields: CurveFields,
}

impl At {
    fn new(normal: Normal, family: DerivativeFamily, state: &State) -> Self {
        let mut grid = PeriodicGrid::new(state.layout.nodes());
        let derivative = Derivative::new(family, &grid);
        let mut fields = CurveFields::new(state.layout, &grid, &derivative);
        fields.set(&spectral(state.layout, &state.y), &mut grid, &derivative);
        let mut mobility = normal.build(&grid, &derivative);
        mobility.set(&fields).expect("a closed curve");
        Self { mobility, fields }
    }

    fn kappa(&self) -> Vec<f64> {
        self.fields.at_nodes(0).to_vec()
    }

    fn apply(&mut self, force: &[f64]) -> Vec<f64> {
        let mut velocity = vec![f64::NAN; force.len()];
        self.mobility.apply(&self.fields, force, &mut velocity);
        velocity
    }
}

fn mean(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / a.len() as f64
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn the_curvature_is_in_the_kernel_and_the_length_is_kept(
        blob in any_blob(), nodes in any_nodes(), eight: bool, seed: u64,
    ) {
        let state = if eight { figure_eight(&blob, nodes, 0) } else { blob.state(nodes, 0) };
        for normal in [Normal::Incompressible, Normal::IncompressibleAreaPreserving] {
            for family in DerivativeFamily::ALL {
                let mut at = At::new(normal, family, &state);
                let kappa = at.kappa();
                let image = at.apply(&kappa);
                prop_assert!(
                    largest(&image) <= 1e-14 * largest(&kappa),
                    "{normal:?}, {family:?}, n = {nodes}: {:.1e}", largest(&image)
                );
                let f = noise(seed, nodes);
                let v = at.apply(&f);
                let rate = mean(&kappa, &v);
                prop_assert!(rate.abs() <= 1e-15 * nodes as f64, "{normal:?}, {family:?}, n = {nodes}: {rate:.1e}");
                // 0 ≤ 𝓑 ≤ Id.
                let (square, whole) = (mean(&f, &v), mean(&f, &f));
                prop_assert!((0.0..=1.0).contains(&(square / whole)), "{normal:?}, {family:?}: {square}");
                prop_assert!(mean(&v, &v) <= square * (1.0 + 1e-12));
            }
        }
    }

    #[test]
    fn mean_velocities_vanish_where_the_area_is_kept(
        blob in any_blob(), nodes in any_nodes(), eight: bool, seed: u64,
    ) {
        let state = if eight { figure_eight(&blob, nodes, 0) } else { blob.state(nodes, 0) };
        let f = noise(seed, nodes);
        for normal in Normal::ALL {
            for family in DerivativeFamily::ALL {
                let mut at = At::new(normal, family, &state);
                let v = at.apply(&f);
                let mean = v.iter().sum::<f64>() / nodes as f64;
                let kept = mean.abs() <= 1e-13 * largest(&v);
                prop_assert!(kept || !at.mobility.keeps().area, "{normal:?}, {family:?}, n = {nodes}: {mean:.1e}");
            }
        }
    }
}

/// n²/(n² + 1) up to the order of the second difference; exactly, with its symbol.
#[test]
fn modes_of_a_circle_are_multiplied_by_the_known_factor() {
    let nodes = 64;
    let state = fixed_blob().state_on(&Shape::Circle { radius: 1.3 }, nodes, 0);
    for family in DerivativeFamily::ALL {
        let mut at = At::new(Normal::Incompressible, family, &state);
        for mode in 0..=8_usize {
            let wave: Vec<f64> =
                (0..nodes).map(|i| (TAU * (mode * i) as f64 / nodes as f64 + 0.7).cos()).collect();
            let v = at.apply(&wave);
            let square = (mode * mode) as f64;
            let factor = square / (square + 1.0);
            let expected: Vec<f64> = wave.iter().map(|f| factor * f).collect();
            let order = family.order().unwrap_or(8);
            let bound = 0.3 * (TAU * mode as f64 / nodes as f64).powi(order) / (square + 1.0) + 1e-14;
            let error = distance(&v, &expected);
            assert!(error <= bound, "{family:?}, mode {mode}: {error:.1e} > {bound:.1e}");
        }
    }
}

/// Of all curves of its length a circle alone has its area.
#[test]
fn a_circle_of_kept_length_and_area_is_held() {
    let nodes = 64;
    let state = fixed_blob().state_on(&Shape::Circle { radius: 1.3 }, nodes, 0);
    for family in DerivativeFamily::ALL {
        let mut at = At::new(Normal::IncompressibleAreaPreserving, family, &state);
        assert_eq!(largest(&at.apply(&noise(3, nodes))), 0.0, "{family:?}");
        assert_eq!(at.mobility.symbol(4.0), 0.0, "{family:?}");
    }
}

/// Nearly a circle, 1 is nearly in the kernel of 𝓘.
#[test]
fn area_is_kept_on_curves_that_are_nearly_circles() {
    let nodes = 64;
    for amplitude in [1e-3, 1e-6, 1e-9, 1e-12] {
        let mut state = fixed_blob().state_on(&Shape::Circle { radius: 1.0 }, nodes, 0);
        for (i, k) in state.y[..nodes].iter_mut().enumerate() {
            *k += amplitude * (3.0 * TAU * i as f64 / nodes as f64).cos();
        }
        let mut at = At::new(Normal::IncompressibleAreaPreserving, DerivativeFamily::Fourier, &state);
        let v = at.apply(&noise(2, nodes));
        let mean = v.iter().sum::<f64>() / nodes as f64;
        assert!(mean.abs() < 1e-11, "{amplitude:.0e}: {mean:.1e}");
        assert!(largest(&v) < 2.0);
    }
}

/// Prop. 3 of the paper: the flux −∇ρ̄ balances local stretching κV, and is the tangential velocity of the gauge.
#[test]
fn the_membrane_flux_balances_local_stretching() {
    for nodes in [128, 255, 1024] {
        let state = fixed_blob().state(nodes, 1);
        for family in DerivativeFamily::ALL {
            let terms = Term::Bending.build(state.layout);
            let densities = [Density::Diffusion];
            let mut flow = flow_under(terms, family, state.layout, Normal::Incompressible, &densities);
            let mut rate = vec![0.0; state.y.len()];
            flow.rate(&state.y, &mut rate);
            let velocity = flow.normal_velocity().to_vec();
            let kappa = flow.current().at_nodes(0).to_vec();
            let length = flow.current().length();
            let stretching: Vec<f64> = kappa.iter().zip(&velocity).map(|(kappa, v)| kappa * v).collect();
            let excess = flow.excess_density(&state.y).expect("a closed curve");
            // −D₋ of the flux per length.
            let mut grid = PeriodicGrid::new(nodes);
            let derivative = Derivative::new(family, &grid);
            let mut spectrum = vec![flow_core::geometry::Complex64::default(); grid.modes()];
            grid.transform(&excess.flux, &mut spectrum);
            for (value, symbol) in spectrum.iter_mut().zip(derivative.to_flux()) {
                *value *= symbol.conj() / length;
            }
            let mut divergence = vec![0.0; nodes];
            grid.synthesise(&spectrum, &mut divergence);
            let scale = largest(&stretching);
            let error = distance(&divergence, &stretching) / scale;
            println!("{family:?}, n = {nodes}: −∇·flux against κV {error:.1e}");
            // Central families: the same second difference. Fourier: one of order 8 in H, the exact one here.
            let bound = match (family, nodes) {
                (DerivativeFamily::Fourier, 128) => 1e-3,
                (DerivativeFamily::Fourier, 255) => 4e-6,
                _ => 1e-10,
            };
            assert!(error < bound, "{family:?}, n = {nodes}: {error:.1e} of {scale:.1e}");
            let length_rate = rate[state.layout.length_index()];
            assert!(length_rate.abs() < 1e-13 * length * scale, "{family:?}: {length_rate:.1e}");
            if family == DerivativeFamily::Fourier {
                let mut tangential = vec![0.0; nodes];
                flow.tangential_velocity(&mut tangential);
                let error = distance(&tangential, &excess.flux) / largest(&excess.flux);
                assert!(error < bound, "n = {nodes}: W against the flux {error:.1e}");
            }
        }
    }
}

#[test]
fn a_line_is_refused_and_gives_no_numbers() {
    let mut state = fixed_blob().state(32, 0);
    state.y[..32].fill(0.0);
    let terms = Term::Tension.build(state.layout);
    let mut flow = flow_under(terms, DerivativeFamily::Fourier, state.layout, Normal::Incompressible, &[]);
    let mut rate = vec![0.0; state.y.len()];
    assert!(flow.rate(&state.y, &mut rate).dissipation.is_nan());
    flow.linearise(&state.y);
    assert!(matches!(flow.linearisation_fault(), Some(MobilityError::Helmholtz(_))));
    flow.linearise(&fixed_blob().state(32, 0).y);
    assert_eq!(flow.linearisation_fault(), None);
}

/// The flow on the grid keeps the area of the curve to the order of the derivative; what is left of it, and the error of the
/// steps, is put back after each step.
#[test]
fn the_area_is_kept_to_the_order_of_the_derivative() {
    use flow_core::geometry::{Embedding, enclosed_area};
    let area = |nodes: usize, y: &[f64]| {
        let mut embedding = Embedding::new(nodes);
        let length = y[nodes];
        embedding.set_tangent(&y[..nodes], length, 0.0);
        embedding.set_position(length, [0.0; 2]);
        enclosed_area(embedding.position(), embedding.tangent(), length)
    };
    let normals = [Normal::AreaPreserving, Normal::IncompressibleAreaPreserving, Normal::SurfaceDiffusion];
    for normal in normals {
        for family in DerivativeFamily::ALL {
            let loss = |nodes: usize| {
                let state = fixed_blob().state(nodes, 0);
                let mut flow =
                    flow_under(Term::Bending.build(state.layout), family, state.layout, normal, &[]);
                let mut rate = vec![0.0; state.y.len()];
                flow.rate(&state.y, &mut rate);
                let v = flow.normal_velocity().to_vec();
                let step = 1e-4 / largest(&v);
                let at = |factor: f64| area(nodes, &moved(&state.y, factor * step, &rate));
                let change = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
                change.abs() / (state.y[nodes] * largest(&v))
            };
            let losses = [64, 128, 256].map(loss);
            println!("{normal:?}, {family:?}: {losses:?}");
            let order = family.order().unwrap_or(8);
            let bound = (losses[0] * 3.0 * 0.25_f64.powi(order)).max(3e-9);
            assert!(losses[2] <= bound, "{normal:?}, {family:?}: {losses:?}");
        }
    }
}
