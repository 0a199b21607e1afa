//! The modes of the flow that a band holds, at its own nodes.

use crate::geometry::{Complex64, PeriodicGrid};

/// The grid of a band beside that of the flow; with scratch.
#[derive(Debug)]
pub struct Window {
    /// That of the band.
    pub grid: PeriodicGrid,
    fine_modes: usize,
    spectrum: Vec<Complex64>,
}

impl Window {
    /// For a flow on `nodes` nodes and a band on `coarse` nodes.
    pub fn new(nodes: usize, coarse: usize) -> Self {
        let grid = PeriodicGrid::new(coarse);
        Self { fine_modes: nodes / 2 + 1, spectrum: vec![Complex64::default(); grid.modes()], grid }
    }

    /// Modes that both hold.
    pub fn common_modes(&self) -> usize {
        self.grid.modes().min(self.fine_modes)
    }

    /// Modes that the band treats.
    pub fn modes(&self) -> usize {
        let modes = self.grid.modes();
        // The sawtooth of a coarser grid has a sine part, which that grid does not see.
        if modes < self.fine_modes { modes - 1 } else { modes }
    }

    /// Nodal `values` of the field `field` in `spectra`, each mode times its factor.
    pub fn synthesise(&mut self, spectra: &[Complex64], field: usize, factors: &[f64], values: &mut [f64]) {
        let spectrum = &spectra[field * self.fine_modes..][..self.modes()];
        self.spectrum.fill(Complex64::default());
        for ((target, value), factor) in self.spectrum.iter_mut().zip(spectrum).zip(factors) {
            *target = value * factor;
        }
        self.grid.synthesise(&self.spectrum, values);
    }

    /// The field `field` of `spectra` from its nodal `values`, each mode times its factor; the mean as it was if it is `kept`.
    pub fn transform(
        &mut self,
        values: &[f64],
        (field, kept): (usize, bool),
        factors: &[f64],
        spectra: &mut [Complex64],
    ) {
        self.grid.transform(values, &mut self.spectrum);
        let spectrum = &mut spectra[field * self.fine_modes..][..self.modes()];
        let modes = spectrum.iter_mut().zip(&self.spectrum).zip(factors);
        for ((target, value), factor) in modes.skip(usize::from(kept)) {
            *target = value * factor;
        }
    }
}
