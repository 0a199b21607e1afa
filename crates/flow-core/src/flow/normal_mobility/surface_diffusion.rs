//! H⁻¹ flow, "surface diffusion": 𝓑 = −`Δ_s`. See `THEORY.md`, eq. (F12).

use super::{Kept, NormalMobility};
use crate::flow::CurveFields;
use crate::geometry::vectors::{multiply, scale};
use crate::geometry::{Complex64, PeriodicGrid};
use crate::operators::{Derivative, GradedLaplacian};

/// Surface diffusion, the H⁻¹ flow: V = −`Δ_s` f by the second derivative of the family. See `THEORY.md`, eq. (F12).
#[derive(Clone, Debug)]
pub struct SurfaceDiffusion {
    grid: PeriodicGrid,
    minus_laplacian: Vec<f64>,
    spectrum: Vec<Complex64>,
    graded: Option<(GradedLaplacian, Vec<Complex64>)>,
}

impl SurfaceDiffusion {
    /// The mobility on a grid.
    #[must_use]
    pub fn new(grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        Self {
            graded: GradedLaplacian::of(grid, derivative)
                .map(|laplacian| (laplacian, vec![Complex64::default(); grid.modes()])),
            grid: grid.clone(),
            minus_laplacian: derivative.minus_laplacian().to_vec(),
            spectrum: vec![Complex64::default(); grid.modes()],
        }
    }
}

impl NormalMobility for SurfaceDiffusion {
    fn is_minus_laplacian(&self) -> bool {
        true
    }

    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        self.grid.transform(force, &mut self.spectrum);
        let factor = at.length().powi(-2);
        if let Some(((laplacian, image), grading)) = self.graded.as_mut().zip(at.grading()) {
            laplacian.apply(grading, &self.spectrum, image);
            self.grid.synthesise(image, velocity);
            multiply(velocity, grading.inverse());
            scale(velocity, factor);
            return;
        }
        for (value, symbol) in self.spectrum.iter_mut().zip(&self.minus_laplacian) {
            *value *= factor * symbol;
        }
        self.grid.synthesise(&self.spectrum, velocity);
    }

    fn symbol(&self, wave_square: f64) -> f64 {
        wave_square
    }

    fn order(&self) -> usize {
        2
    }

    fn keeps(&self) -> Kept {
        Kept { length: false, area: true }
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(self.clone())
    }
}
