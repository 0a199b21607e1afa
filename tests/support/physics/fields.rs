//! Periodic fields on uniform nodes: correlation, slopes, values in between.

use std::f64::consts::TAU;

use flow_core::geometry::{Complex64, PeriodicGrid};

use crate::mean;

/// Correlation of two fields over the nodes.
#[must_use]
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a0, b0) = (mean(a), mean(b));
    let sum = |of: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| of(a - a0, b - b0)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

/// The trigonometric interpolant of a field.
#[derive(Debug)]
pub struct Interpolant {
    grid: PeriodicGrid,
    spectrum: Vec<Complex64>,
}

impl Interpolant {
    /// Through `values` at the nodes s = i/n.
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
        assert!((correlation(&values, &values) - 1.0).abs() < 1e-15);
    }
}
