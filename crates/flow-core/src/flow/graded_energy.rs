//! What graded nodes add to the energy: p = `e_φ` + (1/w)·(Sφ c/|Γ|² + …) with S = D₊ᵀ(1/w)D₊. See `THEORY.md`, eq. (D9).

use std::sync::Arc;

use crate::geometry::vectors::{add_scaled, dot, multiply};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// S with the images of the fields at the linearisation; holds its scratch.
#[derive(Debug)]
pub struct GradedEnergy {
    layout: Layout,
    grid: PeriodicGrid,
    grading: Arc<Grading>,
    laplacian: GradedLaplacian,
    image: Vec<Complex64>,
    frozen: Vec<Complex64>,
    values: Vec<f64>,
}

impl GradedEnergy {
    /// For states of `layout`; none if the nodes are uniform or their metric moves.
    #[must_use]
    pub fn of(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Option<Self> {
        if layout.metric().is_some() {
            return None;
        }
        Some(Self {
            layout,
            grid: grid.clone(),
            grading: derivative.grading()?.clone(),
            laplacian: GradedLaplacian::of(grid, derivative)?,
            image: vec![Complex64::default(); grid.modes()],
            frozen: vec![Complex64::default(); layout.fields() * grid.modes()],
            values: vec![0.0; layout.nodes()],
        })
    }

    /// Spectrum of S of a field.
    pub fn image(&mut self, spectrum: &[Complex64]) -> &[Complex64] {
        self.laplacian.apply(&self.grading, spectrum, &mut self.image);
        &self.image
    }

    /// Keeps the image found last as that of `field` at the linearisation.
    pub fn freeze(&mut self, field: usize) {
        self.frozen[self.layout.spectrum(field)].copy_from_slice(&self.image);
    }

    /// Spectrum of S of `field` at the linearisation.
    #[must_use]
    pub fn frozen(&self, field: usize) -> &[Complex64] {
        &self.frozen[self.layout.spectrum(field)]
    }

    /// p becomes `density` + p/w.
    pub fn finish(&mut self, density: &[f64], p: &mut [Complex64]) {
        self.grid.synthesise(p, &mut self.values);
        multiply(&mut self.values, self.grading.inverse());
        add_scaled(&mut self.values, 1.0, density);
        self.grid.transform(&self.values, p);
    }
}

/// Mean of the product of two fields by Parseval's identity.
pub fn mean_product(grid: &PeriodicGrid, a: &[Complex64], b: &[Complex64]) -> f64 {
    let product = |m: usize| a[m].re * b[m].re + a[m].im * b[m].im;
    let full = dot(bytemuck::cast_slice(a), bytemuck::cast_slice(b));
    2.0 * full - product(0) - grid.sawtooth_mode().map_or(0.0, product)
}

/// out += factor × spectrum.
pub fn add_spectrum(out: &mut [Complex64], factor: f64, spectrum: &[Complex64]) {
    add_scaled(bytemuck::cast_slice_mut(out), factor, bytemuck::cast_slice(spectrum));
}
