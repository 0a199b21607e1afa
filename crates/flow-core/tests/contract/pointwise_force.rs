//! The transposed force against the formula of the continuum,
//! f = −G∂_κ𝓕 − gκ∂_g𝓕 + κρ·∂_ρ𝓕 with G = −(`Δ_s` + κ²): the two differ by the gauge part of A, which is κ times the
//! integral of the residual of parametrisation independence, and by the error of the derivative.

use flow_core::energies::{Bending, EnergyTerm, Length, Regularization};
use flow_core::geometry::{Complex64, Layout, PeriodicGrid, StateRef};
use flow_core::operators::DerivativeFamily;

use crate::states::fixed_blob;
use crate::terms::{DELTA, EPSILON, PENALTY, TARGET, Term, flow_of};
use crate::vectors::{distance, largest};

/// A resolved state with exact slopes.
struct Resolved {
    length: f64,
    kappa: Vec<f64>,
    kappa_slope: Vec<f64>,
    rho: Vec<f64>,
    rho_slope: Vec<f64>,
    y: Vec<f64>,
    layout: Layout,
}

/// ∂_κ𝓕, ∂_ρ𝓕 and g∂_g𝓕 at the nodes.
struct Gradient {
    kappa: Vec<f64>,
    rho: Vec<f64>,
    metric: Vec<f64>,
}

/// nth arc-length derivative, by Fourier.
fn slope(values: &[f64], length: f64, order: i32) -> Vec<f64> {
    let mut grid = PeriodicGrid::new(values.len());
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(values, &mut spectrum);
    for (mode, value) in spectrum.iter_mut().enumerate() {
        *value *= Complex64::new(0.0, grid.wave_number(mode) / length).powi(order);
    }
    let mut out = vec![0.0; values.len()];
    grid.synthesise(&spectrum, &mut out);
    out
}

fn combine(a: &[f64], b: &[f64], f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect()
}

impl Resolved {
    fn new(nodes: usize) -> Self {
        let state = fixed_blob().state(nodes, 1);
        let view = StateRef::new(state.layout, &state.y);
        let (length, kappa, rho) = (view.length(), view.pointwise(0), view.pointwise(1));
        Self {
            length,
            kappa_slope: slope(&kappa, length, 1),
            rho_slope: slope(&rho, length, 1),
            kappa,
            rho,
            layout: state.layout,
            y: state.y,
        }
    }

    /// Values of `f(κ, ρ, κ_σ, ρ_σ)`.
    fn map(&self, f: impl Fn(f64, f64, f64, f64) -> f64) -> Vec<f64> {
        let nodes = 0..self.kappa.len();
        nodes.map(|i| f(self.kappa[i], self.rho[i], self.kappa_slope[i], self.rho_slope[i])).collect()
    }

    /// `Δ_s`, applied with the exact slopes.
    fn laplacian(&self, values: &[f64]) -> Vec<f64> {
        slope(values, self.length, 2)
    }

    fn force(&self, gradient: &Gradient) -> Vec<f64> {
        let bend = self.laplacian(&gradient.kappa);
        let value = |i: usize| {
            let kappa = self.kappa[i];
            bend[i] + kappa * kappa * gradient.kappa[i] - kappa * gradient.metric[i]
                + kappa * self.rho[i] * gradient.rho[i]
        };
        (0..self.kappa.len()).map(value).collect()
    }

    /// Bending 1/2 κ², regularisation and tension.
    fn of_elastica(&self) -> Gradient {
        let stretch = self.laplacian(&self.kappa);
        Gradient {
            kappa: combine(&self.kappa, &stretch, |kappa, stretch| kappa - DELTA * stretch),
            rho: vec![0.0; self.rho.len()],
            metric: self.map(|kappa, _, slope, _| 0.5 * kappa * kappa - 0.5 * DELTA * slope * slope + 0.6),
        }
    }

    /// `MODEL.md`, section 4, with its length penalty.
    fn of_agents(&self) -> Gradient {
        let well = |kappa: f64| {
            let low = 0.16 * (-(kappa - 1.0).powi(2) * (0.16_f64 / 0.14).ln() / 0.09).exp();
            let high = 0.18 * (-(kappa + 0.3).powi(2) * (0.18_f64 / 0.15).ln() / 0.16).exp();
            let low_slope = -2.0 * (kappa - 1.0) * (0.16_f64 / 0.14).ln() / 0.09 * low;
            let high_slope = -2.0 * (kappa + 0.3) * (0.18_f64 / 0.15).ln() / 0.16 * high;
            [0.05 + low, low_slope, 0.80 + high, high_slope]
        };
        let preferred = |rho: f64| 1.3 - 2.0 / 0.76 * (rho - 0.19);
        let of_kappa = self.map(|kappa, rho, _, _| {
            let [low, low_slope, high, high_slope] = well(kappa);
            let (u, v) = (rho - low, rho - high);
            (kappa - preferred(rho)) / DELTA - 8.0 * u * v * (low_slope * v + high_slope * u) / EPSILON
        });
        let of_rho = self.map(|kappa, rho, _, _| {
            let [low, _, high, _] = well(kappa);
            let (u, v) = (rho - low, rho - high);
            (kappa - preferred(rho)) * (2.0 / 0.76) / DELTA + 8.0 * u * v * (u + v) / EPSILON
        });
        let tension = PENALTY * (self.length - TARGET);
        Gradient {
            kappa: combine(&of_kappa, &self.laplacian(&self.kappa), |p, stretch| p - DELTA * stretch),
            rho: combine(&of_rho, &self.laplacian(&self.rho), |p, stretch| p - EPSILON * stretch),
            metric: self.map(|kappa, rho, kappa_slope, rho_slope| {
                let [low, _, high, _] = well(kappa);
                let potential = 4.0 * ((rho - low) * (rho - high)).powi(2) / EPSILON;
                let bending = 0.5 * (kappa - preferred(rho)).powi(2) / DELTA;
                let slopes = 0.5 * DELTA * kappa_slope.powi(2) + 0.5 * EPSILON * rho_slope.powi(2);
                potential + bending - slopes + tension
            }),
        }
    }

    /// The density with slopes of [`Term::LocalWithSlopes`].
    fn of_local(&self) -> Gradient {
        let flux_of_kappa = self.map(|_, rho, slope, _| 0.2 * slope * (1.0 + rho * rho));
        let flux_of_rho = self.map(|_, _, _, slope| 0.4 * slope);
        let of_kappa = self.map(|kappa, rho, _, _| 0.6 * kappa * rho + 0.1 * (0.1 * kappa).exp());
        let of_rho = self.map(|kappa, rho, slope, _| 0.3 * kappa * kappa + 0.2 * rho * slope * slope);
        let divergence = |flux: &[f64]| slope(flux, self.length, 1);
        Gradient {
            kappa: combine(&of_kappa, &divergence(&flux_of_kappa), |p, divergence| p - divergence),
            rho: combine(&of_rho, &divergence(&flux_of_rho), |p, divergence| p - divergence),
            metric: self.map(|kappa, rho, kappa_slope, rho_slope| {
                0.3 * kappa * kappa * rho + (0.1 * kappa).exp()
                    - 0.1 * kappa_slope * kappa_slope * (1.0 + rho * rho)
                    - 0.2 * rho_slope * rho_slope
            }),
        }
    }
}

/// Checks the law for the energy of `terms`. `floor`: rounding of four (six with the regularisation)
/// derivatives at 512 nodes, (πn/|Γ|)⁴ ε relative to the force.
fn agrees(
    terms: impl Fn(Layout) -> Vec<Box<dyn EnergyTerm>>,
    gradient: impl Fn(&Resolved) -> Gradient,
    floor: f64,
) {
    for family in DerivativeFamily::ALL {
        let error = |nodes: usize| {
            let state = Resolved::new(nodes);
            let expected = state.force(&gradient(&state));
            let mut flow = flow_of(terms(state.layout), family, state.layout);
            flow.dissipation_at(&state.y);
            distance(flow.normal_velocity(), &expected) / largest(&expected)
        };
        let (coarse, fine) = (error(256), error(512));
        let measured = (coarse / fine).log2();
        println!("{family:?}: {coarse:.2e}, {fine:.2e}, order {measured:.2}");
        match family.order() {
            None => assert!(fine < floor, "Fourier: {fine:.1e}"),
            Some(order) => assert!(
                (measured / f64::from(order) - 1.0).abs() < ORDER_MARGIN,
                "{family:?}: order {measured:.2} ({coarse:.1e}, {fine:.1e})"
            ),
        }
    }
}

/// The next term of the expansion of the symbols still shows at 256 nodes, the more the higher the order.
const ORDER_MARGIN: f64 = 0.15;

#[test]
fn the_force_of_the_elastica_is_the_pointwise_one() {
    let terms = |_| -> Vec<Box<dyn EnergyTerm>> {
        vec![
            Box::new(Bending::new(1.0)),
            Box::new(Regularization::new(DELTA)),
            Box::new(Length::Tension(0.6)),
        ]
    };
    agrees(terms, Resolved::of_elastica, 1e-8);
}

#[test]
fn the_force_of_the_agents_is_the_pointwise_one() {
    let terms = |layout| {
        let mut terms = Term::Agents.build(layout);
        terms.extend(Term::Penalty.build(layout));
        terms
    };
    agrees(terms, Resolved::of_agents, 1e-8);
}

#[test]
fn the_force_of_a_density_of_slopes_is_the_pointwise_one() {
    agrees(|layout| Term::LocalWithSlopes.build(layout), Resolved::of_local, 1e-8);
}
