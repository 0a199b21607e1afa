//! The trigonometric interpolant of a periodic nodal field, and its values on other nodes.

use std::f64::consts::TAU;

use crate::geometry::{Complex64, PeriodicGrid};

/// The trigonometric interpolant of a field: `THEORY.md`, eq. (D1).
#[derive(Clone, Debug)]
pub struct Interpolant {
    grid: PeriodicGrid,
    spectrum: Vec<Complex64>,
}

impl Interpolant {
    /// Through `values` at the nodes s = i/n.
    ///
    /// # Panics
    /// If there are fewer than two of them.
    #[must_use]
    pub fn new(values: &[f64]) -> Self {
        let mut grid = PeriodicGrid::new(values.len());
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(values, &mut spectrum);
        Self { grid, spectrum }
    }

    /// Value at the parameter `s`.
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        self.sum(|_, coefficient, angle| (coefficient * Complex64::cis(angle)).re, s)
    }

    /// Derivative by s at the parameter `s`.
    #[must_use]
    pub fn slope_at(&self, s: f64) -> f64 {
        self.sum(
            |wave, coefficient, angle| (coefficient * Complex64::new(0.0, wave) * Complex64::cis(angle)).re,
            s,
        )
    }

    /// Integral over s from `start` to `end`.
    #[must_use]
    pub fn integral(&self, start: f64, end: f64) -> f64 {
        let primitive = |s: f64| {
            let waves = |wave: f64, coefficient: Complex64, angle: f64| {
                if wave == 0.0 {
                    coefficient.re * s
                } else {
                    (coefficient * Complex64::cis(angle) / Complex64::new(0.0, wave)).re
                }
            };
            self.sum(waves, s)
        };
        primitive(end) - primitive(start)
    }

    /// Its Fourier coefficients.
    #[must_use]
    pub fn spectrum(&self) -> &[Complex64] {
        &self.spectrum
    }

    /// Values at `count` equidistant nodes, at least as many as it came from.
    ///
    /// # Panics
    /// If there are fewer.
    #[must_use]
    pub fn resampled(&self, count: usize) -> Vec<f64> {
        self.on_nodes(count, |_, coefficient| coefficient)
    }

    /// Derivatives by s at `count` equidistant nodes, at least as many as it came from.
    ///
    /// # Panics
    /// If there are fewer.
    #[must_use]
    pub fn slopes(&self, count: usize) -> Vec<f64> {
        self.on_nodes(count, |wave, coefficient| coefficient * Complex64::new(0.0, wave))
    }

    fn on_nodes(&self, count: usize, symbol: impl Fn(f64, Complex64) -> Complex64) -> Vec<f64> {
        let nodes = self.grid.nodes();
        assert!(count >= nodes, "{count} nodes, fewer than {nodes}, would fold the highest modes");
        let mut finer = PeriodicGrid::new(count);
        let mut spectrum = vec![Complex64::default(); finer.modes()];
        for (mode, coefficient) in self.spectrum.iter().enumerate() {
            // The sawtooth, alone in the coarse spectrum, is a pair of modes in a finer one.
            let share = self.grid.multiplicity(mode) / finer.multiplicity(mode);
            spectrum[mode] = share * symbol(TAU * mode as f64, *coefficient);
        }
        let mut values = vec![0.0; count];
        finer.synthesise(&spectrum, &mut values);
        values
    }

    fn sum(&self, term: impl Fn(f64, Complex64, f64) -> f64, s: f64) -> f64 {
        let terms = self.spectrum.iter().enumerate().map(|(mode, coefficient)| {
            let wave = TAU * mode as f64;
            self.grid.multiplicity(mode) * term(wave, *coefficient, wave * s)
        });
        terms.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interpolant_is_exact_on_waves() {
        let wave = |s: f64| 0.3 + (3.0 * TAU * s).sin();
        let values: Vec<f64> = (0..32).map(|i| wave(f64::from(i) / 32.0)).collect();
        let interpolant = Interpolant::new(&values);
        assert!((interpolant.at(0.123) - wave(0.123)).abs() < 1e-14);
        assert!((interpolant.slope_at(0.2) - 3.0 * TAU * (3.0 * TAU * 0.2).cos()).abs() < 1e-13);
        let primitive = |s: f64| 0.3 * s - (3.0 * TAU * s).cos() / (3.0 * TAU);
        assert!((interpolant.integral(0.1, 0.7) - (primitive(0.7) - primitive(0.1))).abs() < 1e-14);
    }

    #[test]
    fn other_nodes_see_the_same_interpolant() {
        for nodes in [8, 9] {
            // The sawtooth of even grids included.
            let values: Vec<f64> = (0..nodes).map(|i| f64::from(i * i % 5)).collect();
            let interpolant = Interpolant::new(&values);
            for count in [nodes, nodes + 1, 2 * nodes, 3 * nodes + 1] {
                let (resampled, slopes) =
                    (interpolant.resampled(count as usize), interpolant.slopes(count as usize));
                for i in 0..count {
                    let s = f64::from(i) / f64::from(count);
                    assert!((resampled[i as usize] - interpolant.at(s)).abs() < 1e-13, "{nodes} to {count}");
                    let slope = slopes[i as usize] - interpolant.slope_at(s);
                    assert!(slope.abs() < 1e-12, "{nodes} to {count}: {slope:.1e}");
                }
            }
        }
    }
}
