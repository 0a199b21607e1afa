//! Trigonometric polynomials on other grids and at scattered points.

use std::f64::consts::PI;

use super::grid::{Complex64, PeriodicGrid};

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
/// Shape of the Kaiser–Bessel kernel for a grid twice as fine.
const SHAPE: f64 = 0.75 * PI * WIDTH as f64;

/// Scattered parameters at which trigonometric polynomials are evaluated, in O(n log n).
///
/// The coefficients are divided by those of a Kaiser–Bessel kernel and transformed to a grid twice as fine; each value is a sum
/// over [`WIDTH`] of its nodes (Jackson, Meyer, Nishimura & Macovski, IEEE Trans. Med. Imaging 10 (1991) 473).
#[derive(Clone, Debug)]
pub struct ScatteredPoints {
    nodes: usize,
    fine: PeriodicGrid,
    /// One over the coefficients of the kernel, by mode.
    deconvolution: Vec<f64>,
    /// First fine node of each point, and the weights from there on.
    points: Vec<(usize, [f64; WIDTH])>,
    spectrum: Vec<Complex64>,
    values: Vec<f64>,
}

impl ScatteredPoints {
    /// The parameters `points`, for polynomials given on `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize, points: &[f64]) -> Self {
        let fine = PeriodicGrid::new((2 * nodes).max(2 * WIDTH));
        let count = fine.nodes() as f64;
        let peak = bessel_i0(SHAPE);
        let weights = |s: &f64| {
            let place = s.rem_euclid(1.0) * count;
            let first = (place - 0.5 * WIDTH as f64).ceil();
            let weights = std::array::from_fn(|i| {
                let z = (first + i as f64 - place) / (0.5 * WIDTH as f64);
                bessel_i0(SHAPE * (1.0 - z * z).max(0.0).sqrt()) / peak
            });
            (first.rem_euclid(count) as usize % fine.nodes(), weights)
        };
        let coefficient = |mode: usize| {
            let wave = PI * WIDTH as f64 * mode as f64 / count;
            let root = (SHAPE * SHAPE - wave * wave).sqrt();
            WIDTH as f64 * root.sinh() / (root * peak)
        };
        Self {
            nodes,
            deconvolution: (0..=nodes / 2).map(|mode| 1.0 / coefficient(mode)).collect(),
            points: points.iter().map(weights).collect(),
            spectrum: vec![Complex64::default(); fine.modes()],
            values: vec![0.0; fine.nodes()],
            fine,
        }
    }

    /// Values at the points of the polynomial with the coefficients `spectrum`.
    pub fn values(&mut self, spectrum: &[Complex64]) -> Vec<f64> {
        resample_spectrum(self.nodes, spectrum, self.fine.nodes(), &mut self.spectrum);
        for (value, factor) in self.spectrum.iter_mut().zip(&self.deconvolution) {
            *value *= *factor;
        }
        self.fine.synthesise(&self.spectrum, &mut self.values);
        let count = self.values.len();
        let sum = |(first, weights): &(usize, [f64; WIDTH])| {
            let at = |i: usize| self.values[if first + i < count { first + i } else { first + i - count }];
            weights.iter().enumerate().map(|(i, weight)| weight * at(i)).sum()
        };
        self.points.iter().map(sum).collect()
    }
}

/// Modified Bessel function I₀ by its power series; all terms are positive.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    let mut k = 1.0;
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
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
