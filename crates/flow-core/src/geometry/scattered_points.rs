//! Trigonometric polynomials at scattered points.

use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use multiversion::multiversion;

use super::grid::{Complex64, PeriodicGrid};
use super::kept::Kept;
use super::resampling::resample_spectrum;
use crate::expression::vector_math::exp;

/// Width of the kernel in nodes of the fine grid; the error is then rounding.
const WIDTH: usize = 14;
/// The same in whole vector registers.
const REGISTERS: usize = WIDTH.next_multiple_of(8);
/// Shape of the kernel e^{β(√(1−z²) − 1)} for a grid twice as fine.
const SHAPE: f64 = 2.3 * WIDTH as f64;
/// Points of the trapezoidal rule for the coefficients of the kernel: exact to rounding.
const QUADRATURE: usize = 40;
/// Modes after which the waves of that rule are computed afresh.
const EXACT: usize = 32;

/// The weights of consecutive fine nodes, zero beyond the kernel.
type Weights = [f64; REGISTERS];

/// Scattered parameters at which trigonometric polynomials are evaluated, in O(n log n).
///
/// The coefficients are divided by those of a kernel and transformed to a grid twice as fine; each value is a sum over fourteen
/// of its nodes (Barnett, Magland & af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479).
#[derive(Clone, Debug)]
pub struct ScatteredPoints {
    nodes: usize,
    fine: PeriodicGrid,
    /// One over the coefficients of the kernel, by mode.
    deconvolution: Arc<[f64]>,
    /// First fine node of each point, and the weights from there on.
    firsts: Vec<usize>,
    weights: Vec<Weights>,
    spectrum: Vec<Complex64>,
    /// Values at the fine nodes, and those of the first ones again.
    values: Vec<f64>,
}

impl ScatteredPoints {
    /// The parameters `places`, for polynomials given on `nodes` nodes. At a place that is not finite their value is NaN.
    #[must_use]
    pub fn new(nodes: usize, places: &[f64]) -> Self {
        let fine = PeriodicGrid::new((2 * nodes).max(2 * WIDTH));
        let coefficients = || deconvolution(nodes, fine.nodes()).into();
        let mut points = Self {
            nodes,
            deconvolution: DECONVOLUTIONS.with_borrow_mut(|kept| kept.of(nodes, coefficients)),
            firsts: vec![0; places.len()],
            weights: vec![[0.0; REGISTERS]; places.len()],
            spectrum: vec![Complex64::default(); fine.modes()],
            values: vec![0.0; fine.nodes() + REGISTERS],
            fine,
        };
        points.move_to(places);
        points
    }

    /// Takes other parameters, as many as before.
    pub(super) fn move_to(&mut self, places: &[f64]) {
        spread(places, self.fine.nodes(), &mut self.firsts, &mut self.weights);
    }

    /// Values at the points of the polynomial with the coefficients `spectrum`.
    ///
    /// # Panics
    /// If these are not the `nodes`/2 + 1 coefficients of `nodes` nodes.
    pub fn values(&mut self, spectrum: &[Complex64]) -> Vec<f64> {
        assert_eq!(spectrum.len(), self.nodes / 2 + 1, "the coefficients of {} nodes", self.nodes);
        resample_spectrum(self.nodes, spectrum, self.fine.nodes(), &mut self.spectrum);
        for (value, factor) in self.spectrum.iter_mut().zip(&*self.deconvolution) {
            *value *= *factor;
        }
        let (fine, again) = self.values.split_at_mut(self.fine.nodes());
        self.fine.synthesise(&self.spectrum, fine);
        again.copy_from_slice(&fine[..REGISTERS]);
        let mut values = vec![0.0; self.firsts.len()];
        gather(&self.firsts, &self.weights, &self.values, &mut values);
        values
    }
}

/// The first of the fine nodes around each of the `places`, and the weights from there on.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn spread(places: &[f64], fine: usize, firsts: &mut [usize], weights: &mut [Weights]) {
    let count = fine as f64;
    for ((s, first), weights) in places.iter().zip(firsts).zip(weights) {
        let place = (s - s.floor()) * count;
        let node = (place - 0.5 * WIDTH as f64).ceil();
        for (i, weight) in weights.iter_mut().enumerate() {
            let z = (node - place + i as f64) * (2.0 / WIDTH as f64);
            let square = 1.0 - z * z;
            let height = if square < 0.0 { 0.0 } else { square }; // NaN passes through
            let kernel = exp(SHAPE * (height.sqrt() - 1.0));
            *weight = if i < WIDTH { kernel } else { 0.0 };
        }
        *first = if node < 0.0 { node + count } else { node } as usize % fine;
    }
}

/// The weighted sums over the fine `values`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn gather(firsts: &[usize], weights: &[Weights], values: &[f64], out: &mut [f64]) {
    for ((first, weights), out) in firsts.iter().zip(weights).zip(out) {
        let Some((near, _)) = values[*first..].split_first_chunk::<REGISTERS>() else { continue };
        let mut lanes = [0.0; 8];
        for (lane, sum) in lanes.iter_mut().enumerate() {
            *sum = weights[lane] * near[lane] + weights[lane + 8] * near[lane + 8];
        }
        let pairs: [f64; 4] = std::array::from_fn(|i| lanes[i] + lanes[i + 4]);
        *out = (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]);
    }
}

thread_local! {
    /// A run that changes its nodes tries the same few numbers again and again; the coefficients take an eighth of a trial.
    static DECONVOLUTIONS: RefCell<Kept<Arc<[f64]>>> = RefCell::default();
}

/// One over the coefficients of the kernel on a grid of `fine` nodes, for the modes of one of `nodes`.
fn deconvolution(nodes: usize, fine: usize) -> Vec<f64> {
    // ∫ e^{β(√(1−z²) − 1)} cos kz dz with z = sin t, over half of the kernel, twice.
    let mut points = [0.0; QUADRATURE];
    let mut shares = [0.0; QUADRATURE];
    for (i, (point, share)) in points.iter_mut().zip(&mut shares).enumerate() {
        let t = (i as f64 + 0.5) / QUADRATURE as f64 * FRAC_PI_2;
        *point = PI * WIDTH as f64 * t.sin() / fine as f64;
        *share = WIDTH as f64 * FRAC_PI_2 / QUADRATURE as f64 * t.cos() * (SHAPE * (t.cos() - 1.0)).exp();
    }
    let turns = points.map(Complex64::cis);
    let mut waves = [Complex64::default(); QUADRATURE];
    let coefficient = |mode: usize| {
        // A cosine costs as much as the turns of many modes, but rounding must not gather.
        if mode.is_multiple_of(EXACT) {
            waves = points.map(|point| Complex64::cis(mode as f64 * point));
        }
        1.0 / turn(&mut waves, &turns, &shares)
    };
    (0..=nodes / 2).map(coefficient).collect()
}

/// Σ share Re wave; each wave goes on by its turn.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn turn(
    waves: &mut [Complex64; QUADRATURE],
    turns: &[Complex64; QUADRATURE],
    shares: &[f64; QUADRATURE],
) -> f64 {
    let sum = waves.iter().zip(shares).map(|(wave, share)| wave.re * share).sum();
    for (wave, turn) in waves.iter_mut().zip(turns) {
        *wave *= turn;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn scattered_values_are_those_of_the_sum() {
        for nodes in [8, 9, 64, 96] {
            let mut grid = PeriodicGrid::new(nodes);
            let nodal: Vec<f64> = (0..nodes).map(|i| ((i * i) % 7) as f64).collect();
            let mut spectrum = vec![Complex64::default(); grid.modes()];
            grid.transform(&nodal, &mut spectrum);
            let points: Vec<f64> = (0..50).map(|i| 0.0213 * f64::from(i * i) - 3.0).collect();
            let values = ScatteredPoints::new(nodes, &points).values(&spectrum);
            for (s, value) in points.iter().zip(values) {
                let wave = |(mode, c): (usize, &Complex64)| {
                    grid.multiplicity(mode) * (c * Complex64::cis(TAU * mode as f64 * s)).re
                };
                let exact: f64 = spectrum.iter().enumerate().map(wave).sum();
                assert!((value - exact).abs() < 3e-12, "{nodes} nodes, s = {s}: {value} ≠ {exact}");
            }
        }
    }
}
