//! S = D₊ᵀ(1/w)D₊ on graded nodes, so that −`Δ_s` = S/(|Γ|²w): symmetric, ≥ 0, zero on constants only.
//! See `THEORY.md`, eq. (D8).

use super::derivative::Derivative;
use crate::geometry::vectors::{apply_symbol, mean_of_product, multiply, multiply_by, multiply_by_conjugate};
use crate::geometry::{Complex64, Grading, PeriodicGrid};

/// Applies S = D₊ᵀ(1/w)D₊, with −`Δ_s` = S/(|Γ|²w), and products with powers of w to spectra, for any grading w on the nodes; holds its
/// scratch. See `THEORY.md`, eq. (D8).
#[derive(Clone, Debug)]
pub struct GradedLaplacian {
    grid: PeriodicGrid,
    to_flux: Vec<Complex64>,
    inverse_to_flux: Vec<Complex64>,
    values: Vec<f64>,
}

impl GradedLaplacian {
    /// S of `derivative`; none if its nodes are uniform.
    #[must_use]
    pub fn of(grid: &PeriodicGrid, derivative: &Derivative) -> Option<Self> {
        derivative.grading()?;
        Some(Self {
            grid: grid.clone(),
            to_flux: derivative.to_flux().to_vec(),
            inverse_to_flux: derivative.inverse_to_flux().to_vec(),
            values: vec![0.0; grid.nodes()],
        })
    }

    /// out = S of the field with the Fourier coefficients `spectrum`.
    pub fn apply(&mut self, grading: &Grading, spectrum: &[Complex64], out: &mut [Complex64]) {
        apply_symbol(out, spectrum, &self.to_flux);
        self.grid.synthesise(out, &mut self.values);
        multiply(&mut self.values, grading.inverse_at_midpoints());
        self.grid.transform(&self.values, out);
        multiply_by_conjugate(out, 1.0, &self.to_flux);
    }

    /// Replaces f by u with Su = f less its mean; u has mean zero over the nodes.
    pub fn solve(&mut self, grading: &Grading, spectrum: &mut [Complex64]) {
        spectrum[0] = Complex64::default();
        multiply_by_conjugate(spectrum, 1.0, &self.inverse_to_flux);
        self.grid.synthesise(spectrum, &mut self.values);
        // D₊u = w(q + c) has mean zero.
        let weight = grading.at_midpoints();
        let constant = mean_of_product(weight, &self.values) / grading.midpoint_mean();
        self.values.iter_mut().for_each(|q| *q -= constant);
        multiply(&mut self.values, weight);
        self.grid.transform(&self.values, spectrum);
        multiply_by(spectrum, &self.inverse_to_flux);
    }

    /// Multiplies a field by w.
    pub fn weigh(&mut self, grading: &Grading, spectrum: &mut [Complex64]) {
        self.grid.synthesise(spectrum, &mut self.values);
        multiply(&mut self.values, grading.weight());
        self.grid.transform(&self.values, spectrum);
    }
}
