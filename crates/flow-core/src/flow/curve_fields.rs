//! The fields of one state where the operators need them: at nodes, as spectra, at flux points.

use crate::geometry::{Complex64, Layout, PeriodicGrid, StateRef};
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

    /// Takes the fields from a state vector.
    pub fn set(&mut self, y: &[f64], grid: &mut PeriodicGrid, derivative: &Derivative) {
        let state = StateRef::new(self.layout, y);
        self.length = state.length();
        let inverse = 1.0 / self.length;
        for (value, y) in self.pointwise.iter_mut().zip(y) {
            *value = inverse * y;
        }
        for field in 0..self.layout.fields() {
            let range = self.layout.field(field);
            let spectrum = &mut self.spectra[field * self.modes..(field + 1) * self.modes];
            grid.transform(&self.pointwise[range.clone()], spectrum);
            if let (Some(symbol), Some(values)) = (derivative.interpolation(), &mut self.interpolated) {
                for ((scratch, spectrum), symbol) in self.scratch.iter_mut().zip(&*spectrum).zip(symbol) {
                    *scratch = spectrum * symbol;
                }
                grid.synthesise(&mut self.scratch, &mut values[range]);
            }
        }
    }

    /// Copies another state's fields of the same layout.
    pub fn copy_from(&mut self, other: &Self) {
        self.length = other.length;
        self.pointwise.copy_from_slice(&other.pointwise);
        self.spectra.copy_from_slice(&other.spectra);
        if let (Some(to), Some(from)) = (&mut self.interpolated, &other.interpolated) {
            to.copy_from_slice(from);
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
