//! The fields of one state where the operators need them: at nodes, as spectra, at flux points.

use crate::geometry::vectors::{apply_symbol, scale_into};
use crate::geometry::{Complex64, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::Derivative;

/// Pointwise fields κ, ρ¹, ρ², … of one state.
#[derive(Clone, Debug)]
pub struct CurveFields {
    layout: Layout,
    modes: usize,
    length: f64,
    pointwise: Vec<f64>,
    spectra: Vec<Complex64>,
    /// Fields at the flux points, unless these are the nodes.
    interpolated: Option<Vec<f64>>,
    scratch: Vec<Complex64>,
}

impl CurveFields {
    /// Room for one state.
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let (size, modes) = (layout.fields() * layout.nodes(), grid.modes());
        Self {
            layout,
            modes,
            length: 1.0,
            pointwise: vec![0.0; size],
            spectra: vec![Complex64::default(); layout.fields() * modes],
            interpolated: derivative.interpolation().map(|_| vec![0.0; size]),
            scratch: vec![Complex64::default(); modes],
        }
    }

    /// Takes the fields from a spectral state vector.
    pub fn set(&mut self, state: &[f64], grid: &mut PeriodicGrid, derivative: &Derivative) {
        let layout = SpectralLayout::new(self.layout);
        self.length = state[layout.length_index()];
        let pairs = bytemuck::cast_slice_mut(&mut self.spectra);
        scale_into(pairs, 1.0 / self.length, &state[..layout.length_index()]);
        for field in 0..self.layout.fields() {
            let range = self.layout.field(field);
            let spectrum = &self.spectra[field * self.modes..(field + 1) * self.modes];
            grid.synthesise(spectrum, &mut self.pointwise[range.clone()]);
            if let (Some(symbol), Some(values)) = (derivative.interpolation(), &mut self.interpolated) {
                apply_symbol(&mut self.scratch, spectrum, symbol);
                grid.synthesise(&self.scratch, &mut values[range]);
            }
        }
    }

    /// Shape of the state.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Length |Γ|, the uniform metric.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// All pointwise fields, one after the other.
    #[must_use]
    pub fn pointwise(&self) -> &[f64] {
        &self.pointwise
    }

    /// Field `field` at the nodes.
    #[must_use]
    pub fn at_nodes(&self, field: usize) -> &[f64] {
        &self.pointwise[self.layout.field(field)]
    }

    /// Field `field` at the flux points.
    #[must_use]
    pub fn at_flux_points(&self, field: usize) -> &[f64] {
        &self.interpolated.as_ref().unwrap_or(&self.pointwise)[self.layout.field(field)]
    }

    /// Fourier coefficients of field `field`.
    #[must_use]
    pub fn spectrum(&self, field: usize) -> &[Complex64] {
        &self.spectra[field * self.modes..(field + 1) * self.modes]
    }
}
