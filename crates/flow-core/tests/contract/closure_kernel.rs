//! What the flow map does not see: the closure gap (kernel of its transpose) and rigid motions (its kernel).

use std::f64::consts::TAU;

use flow_core::flow::{CurveFields, FlowMap};
use flow_core::geometry::{Complex64, Embedding, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};

use crate::states::{State, fixed_blob, spectral};
use crate::vectors::{largest, noise};

const DENSITIES: usize = 1;

/// A curve in the plane, with the flow map of one family.
struct Moving {
    state: State,
    grid: PeriodicGrid,
    derivative: Derivative,
    embedding: Embedding,
    length: f64,
}

impl Moving {
    fn new(family: DerivativeFamily, nodes: usize) -> Self {
        let state = fixed_blob().state(nodes, DENSITIES);
        let grid = PeriodicGrid::new(nodes);
        let derivative = Derivative::new(family, &grid);
        let length = state.y[state.layout.length_index()];
        let mut embedding = Embedding::new(nodes);
        embedding.set_tangent(&state.y[state.layout.field(0)], length, 0.4);
        embedding.set_position(length, [0.3, -0.2]);
        Self { state, grid, derivative, embedding, length }
    }

    /// Rates of the state under the normal velocity `v`.
    fn rates(&mut self, v: &[f64]) -> Vec<f64> {
        let layout = self.state.layout;
        let mut map = FlowMap::new(layout, &self.grid, &self.derivative);
        let mut at = CurveFields::new(layout, &self.grid, &self.derivative);
        at.set(&spectral(layout, &self.state.y), &mut self.grid, &self.derivative);
        let modes = self.grid.modes();
        let mut spectra = vec![Complex64::default(); layout.fields() * modes];
        let mut rates = vec![0.0; layout.len()];
        rates[layout.length_index()] = map.rates(&at, v, &mut spectra);
        for field in 0..layout.fields() {
            let spectrum = &mut spectra[field * modes..(field + 1) * modes];
            self.grid.synthesise(spectrum, &mut rates[layout.field(field)]);
        }
        rates
    }

    /// The periodic function with the spectrum of `values` times `symbol`.
    fn filtered(&mut self, values: &[f64], symbol: impl Fn(f64) -> Complex64) -> Vec<f64> {
        let mut spectrum = vec![Complex64::default(); self.grid.modes()];
        self.grid.transform(values, &mut spectrum);
        for (mode, value) in spectrum.iter_mut().enumerate() {
            *value *= symbol(self.grid.wave_number(mode));
        }
        let mut out = vec![0.0; values.len()];
        self.grid.synthesise(&spectrum, &mut out);
        out
    }

    /// Rate of the gap ∫τ dσ under `rates`, relative to the largest rate of the turning.
    fn gap_rate(&mut self, rates: &[f64]) -> f64 {
        let turning_rate = &rates[self.state.layout.field(0)];
        let angle_rate = self.filtered(turning_rate, |k| {
            if k == 0.0 { Complex64::default() } else { Complex64::new(0.0, -1.0 / k) }
        });
        // δ∫τ dσ = |Γ|⟨τ^⊥ δθ⟩ + δ|Γ|⟨τ⟩; the curve is closed: ⟨τ⟩ = 0.
        let [tx, ty] = self.embedding.tangent();
        let moment = |t: &[f64]| t.iter().zip(&angle_rate).map(|(t, a)| t * a).sum::<f64>();
        let scale = self.length / angle_rate.len() as f64;
        scale * moment(tx).hypot(moment(ty)) / largest(turning_rate)
    }

    /// Normal and tangential parts n·e and τ·e of the translation `γ_t` = e = (cos 1, sin 1), with n = (`τ_y`, −`τ_x`).
    fn translation(&self) -> [Vec<f64>; 2] {
        let ([tx, ty], [c, s]) = (self.embedding.tangent(), [1f64.cos(), 1f64.sin()]);
        let normal = (0..tx.len()).map(|i| c * ty[i] - s * tx[i]).collect();
        let tangential = (0..tx.len()).map(|i| c * tx[i] + s * ty[i]).collect();
        [normal, tangential]
    }

    /// Normal and tangential parts −γ·τ and γ·n of the rotation `γ_t` = γ^⊥.
    fn rotation(&self) -> [Vec<f64>; 2] {
        let ([tx, ty], [x, y]) = (self.embedding.tangent(), self.embedding.position());
        let normal = (0..tx.len()).map(|i| -(x[i] * tx[i] + y[i] * ty[i])).collect();
        let tangential = (0..tx.len()).map(|i| x[i] * ty[i] - y[i] * tx[i]).collect();
        [normal, tangential]
    }

    /// Largest difference of the rates under a rigid motion from what they are.
    ///
    /// The nodes move by Vn + (W − c)τ, c the mean of W, which the gauge takes out: the curve is at rest but for
    /// the shift of its nodes, `K_t = −c∂_sκ`. A density stays with the normal motion: `m_t = ∂_s(ρ(W − c))`.
    fn rigid_motion_error(&mut self, [v, w]: [Vec<f64>; 2]) -> f64 {
        let mut rates = self.rates(&v);
        let carried = w.iter().sum::<f64>() / w.len() as f64;
        for field in 0..=DENSITIES {
            let range = self.state.layout.field(field);
            let value =
                |(y, w): (&f64, &f64)| y / self.length * if field == 0 { -carried } else { w - carried };
            let flux: Vec<f64> = self.state.y[range.clone()].iter().zip(&w).map(value).collect();
            let expected = self.filtered(&flux, |k| Complex64::new(0.0, k));
            rates[range].iter_mut().zip(&expected).for_each(|(rate, expected)| *rate -= expected);
        }
        largest(&rates)
    }
}

/// A velocity of few modes.
fn velocity(nodes: usize) -> Vec<f64> {
    let c = noise(7, 8);
    let value = |s: f64| (0..4).map(|k| c[2 * k] * (k as f64 * s + 3.0 * c[2 * k + 1]).cos()).sum();
    (0..nodes).map(|i| value(TAU * i as f64 / nodes as f64)).collect()
}

/// Checks that `error` falls at the order of every family, and to `floor` for Fourier.
fn falls_at_its_order(law: &str, floor: f64, error: impl Fn(DerivativeFamily, usize) -> f64) {
    for family in DerivativeFamily::ALL {
        let (coarse, fine) = (error(family, 192), error(family, 384));
        let measured = (coarse / fine).log2();
        println!("{law}: {family:?}: {coarse:.2e}, {fine:.2e}, order {measured:.2}");
        match family.order() {
            None => assert!(fine < floor, "{law}: Fourier: {fine:.1e}"),
            Some(order) => assert!(
                (measured / f64::from(order) - 1.0).abs() < ORDER_MARGIN,
                "{law}: {family:?}: order {measured:.2} ({coarse:.1e}, {fine:.1e})"
            ),
        }
    }
}

/// The next term of the expansion of the symbols still shows at 192 nodes, the more the higher the order.
const ORDER_MARGIN: f64 = 0.1;

/// Rounding of second derivatives at 384 nodes, (πn)² ε/|Γ| = 2e-11, with room.
const FLOOR: f64 = 1e-9;

#[test]
fn no_normal_velocity_opens_the_curve_beyond_the_order_of_the_derivative() {
    falls_at_its_order("closure", FLOOR, |family, nodes| {
        let mut curve = Moving::new(family, nodes);
        let rates = curve.rates(&velocity(nodes));
        curve.gap_rate(&rates)
    });
}

#[test]
fn translations_leave_the_curve_at_rest_to_the_order_of_the_derivative() {
    falls_at_its_order("translation", FLOOR, |family, nodes| {
        let mut curve = Moving::new(family, nodes);
        let motion = curve.translation();
        curve.rigid_motion_error(motion)
    });
}

#[test]
fn rotations_leave_the_curve_at_rest_to_the_order_of_the_derivative() {
    falls_at_its_order("rotation", FLOOR, |family, nodes| {
        let mut curve = Moving::new(family, nodes);
        let motion = curve.rotation();
        curve.rigid_motion_error(motion)
    });
}
