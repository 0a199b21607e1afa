//! Trigonometric polynomials on other grids and at scattered points.

use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use multiversion::multiversion;

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};
use super::kept::Kept;
use crate::expression::vector_math::exp;

/// The coefficients on a grid of `to` nodes of the polynomial with the coefficients `spectrum` on `nodes` nodes. Modes that the
/// new grid does not hold are lost.
pub fn resample_spectrum(nodes: usize, spectrum: &[Complex64], to: usize, out: &mut [Complex64]) {
    out.fill(Complex64::default());
    for (mode, (target, value)) in out.iter_mut().zip(spectrum).enumerate() {
        // The sawtooth, alone in the spectrum of a grid, is a pair of modes in that of a finer one.
        let share = PeriodicGrid::multiplicity_on(nodes, mode) / PeriodicGrid::multiplicity_on(to, mode);
        *target = share * value;
        if 2 * mode == to {
            target.im = 0.0;
        }
    }
}

/// Periodic nodal values on `count` nodes instead.
#[must_use]
pub fn resample(values: &[f64], count: usize) -> Vec<f64> {
    let (mut old, mut new) = (PeriodicGrid::new(values.len()), PeriodicGrid::new(count));
    let mut spectrum = vec![Complex64::default(); old.modes()];
    let mut resampled = vec![Complex64::default(); new.modes()];
    let mut out = vec![0.0; count];
    old.transform(values, &mut spectrum);
    resample_spectrum(values.len(), &spectrum, count, &mut resampled);
    new.synthesise(&resampled, &mut out);
    out
}

/// Width of the kernel in nodes of the fine grid; the error is then rounding.
const WIDTH: usize = 14;
/// Shape of the kernel e^{β(√(1−z²) − 1)} for a grid twice as fine.
const SHAPE: f64 = 2.3 * WIDTH as f64;
/// Points of the trapezoidal rule for the coefficients of the kernel: exact to rounding.
const QUADRATURE: usize = 40;
/// Modes after which the waves of that rule are computed afresh.
const EXACT: usize = 32;

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
    points: Vec<(usize, [f64; WIDTH])>,
    spectrum: Vec<Complex64>,
    values: Vec<f64>,
}

impl ScatteredPoints {
    /// The parameters `places`, for polynomials given on `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize, places: &[f64]) -> Self {
        let fine = PeriodicGrid::new((2 * nodes).max(2 * WIDTH));
        let coefficients = || deconvolution(nodes, fine.nodes()).into();
        let mut points = Self {
            nodes,
            deconvolution: DECONVOLUTIONS.with_borrow_mut(|kept| kept.of(nodes, coefficients)),
            points: Vec::with_capacity(places.len()),
            spectrum: vec![Complex64::default(); fine.modes()],
            values: vec![0.0; fine.nodes()],
            fine,
        };
        points.move_to(places);
        points
    }

    /// Takes other parameters.
    fn move_to(&mut self, places: &[f64]) {
        let nodes = self.fine.nodes();
        let count = nodes as f64;
        self.points.clear();
        self.points.extend(places.iter().map(|s| {
            let place = s.rem_euclid(1.0) * count;
            let first = (place - 0.5 * WIDTH as f64).ceil();
            (first.rem_euclid(count) as usize % nodes, weights(first - place))
        }));
    }

    /// Values at the points of the polynomial with the coefficients `spectrum`.
    pub fn values(&mut self, spectrum: &[Complex64]) -> Vec<f64> {
        resample_spectrum(self.nodes, spectrum, self.fine.nodes(), &mut self.spectrum);
        for (value, factor) in self.spectrum.iter_mut().zip(&*self.deconvolution) {
            *value *= *factor;
        }
        self.fine.synthesise(&self.spectrum, &mut self.values);
        let count = self.values.len();
        let sum = |(first, weights): &(usize, [f64; WIDTH])| -> f64 {
            let within = WIDTH.min(count - first);
            let (before, after) = weights.split_at(within);
            let product = |(weight, value): (&f64, &f64)| weight * value;
            let up_to_the_end: f64 = before.iter().zip(&self.values[*first..]).map(product).sum();
            up_to_the_end + after.iter().zip(&self.values).map(product).sum::<f64>()
        };
        self.points.iter().map(sum).collect()
    }
}

/// Weights of the fine nodes, the first of which is at `distance` from the point.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn weights(distance: f64) -> [f64; WIDTH] {
    const WHOLE_REGISTERS: usize = WIDTH.next_multiple_of(8);
    let mut kernel = [0.0; WHOLE_REGISTERS];
    for (i, value) in kernel.iter_mut().enumerate() {
        let z = (distance + i as f64) * (2.0 / WIDTH as f64);
        let square = 1.0 - z * z;
        let height = if square > 0.0 { square } else { 0.0 };
        *value = exp(SHAPE * (height.sqrt() - 1.0));
    }
    std::array::from_fn(|i| kernel[i])
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

/// Passes of Newton's method; the start is within the fourth power of a node distance.
const MOST_PASSES: usize = 8;
/// Error of the fraction of the arc length that the next pass brings to rounding.
const FOUND: f64 = 1e-8;

/// Parameters of the nodes of `grading` where the `fractions` of the arc length are reached, by Newton's method within the
/// interval between two nodes.
#[must_use]
pub fn parameters_of_fractions(grading: &Grading, fractions: &[f64]) -> Vec<f64> {
    let nodes = grading.nodes();
    let mut grid = PeriodicGrid::new(nodes);
    let mut spectra = [vec![Complex64::default(); grid.modes()], vec![Complex64::default(); grid.modes()]];
    grid.transform(grading.shift(), &mut spectra[0]);
    grid.transform(grading.weight(), &mut spectra[1]);
    let at_nodes = grading.fractions();
    let interval = |x: &f64| {
        let right = at_nodes.partition_point(|at| at <= x);
        [right.max(1) - 1, right.max(1)].map(|i| i as f64 / nodes as f64)
    };
    let mut intervals: Vec<[f64; 2]> = fractions.iter().map(interval).collect();
    // The cubic of Hermite for s(x), whose slope is 1/w.
    let inverse = |(x, [low, high]): (&f64, &[f64; 2])| {
        let left = (low * nodes as f64).round() as usize;
        let reached = at_nodes[left];
        let next = at_nodes.get(left + 1).copied().unwrap_or(1.0);
        let (distance, part) = (next - reached, (x - reached) / (next - reached));
        let slope = |node: usize| distance * grading.inverse()[node % nodes] - (high - low);
        let bend = (1.0 - part) * slope(left) - part * slope(left + 1);
        (low + (high - low) * part + part * (1.0 - part) * bend).clamp(*low, *high)
    };
    let mut found: Vec<f64> = fractions.iter().zip(&intervals).map(inverse).collect();
    let mut points = ScatteredPoints::new(nodes, &found);
    for _ in 0..MOST_PASSES {
        let [shifts, slopes] = spectra.each_ref().map(|spectrum| points.values(spectrum));
        let mut worst = 0.0_f64;
        for (i, s) in found.iter_mut().enumerate() {
            let excess = *s + shifts[i] - fractions[i];
            worst = worst.max(excess.abs());
            intervals[i][usize::from(excess > 0.0)] = *s;
            let [low, high] = intervals[i];
            let aim = *s - excess / slopes[i];
            // A node itself may be the solution, to rounding.
            *s = if (low..=high).contains(&aim) { aim } else { 0.5 * (low + high) };
        }
        if worst <= FOUND {
            break;
        }
        points.move_to(&found);
    }
    found
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

    #[test]
    fn a_finer_grid_holds_the_same_polynomial() {
        let (mut coarse, mut fine) = (PeriodicGrid::new(8), PeriodicGrid::new(24));
        let nodal: Vec<f64> = (0..8).map(|i| f64::from(i * i % 5)).collect();
        let mut spectrum = vec![Complex64::default(); coarse.modes()];
        coarse.transform(&nodal, &mut spectrum);
        let (mut finer, mut values) = (vec![Complex64::default(); fine.modes()], vec![0.0; 24]);
        resample_spectrum(8, &spectrum, 24, &mut finer);
        fine.synthesise(&finer, &mut values);
        for i in 0..8 {
            assert!((values[3 * i] - nodal[i]).abs() < 1e-14);
        }
        let mut back = vec![Complex64::default(); coarse.modes()];
        resample_spectrum(24, &finer, 8, &mut back);
        assert!(back.iter().zip(&spectrum).all(|(a, b)| (a - b).norm() < 1e-14));
    }
}
