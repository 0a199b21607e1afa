//! The fields of one state where the operators need them: at nodes, as spectra, at flux points.

use std::sync::Arc;

use crate::geometry::vectors::{
    apply_symbol, mean, mean_of_product, mean_of_triple_product, multiply, scale_into,
};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid, SpectralLayout};
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
    graded: Option<Graded>,
    scratch: Vec<Complex64>,
}

/// What differs from the uniform metric.
#[derive(Clone, Debug)]
struct Graded {
    grading: Arc<Grading>,
    /// Spectra of wφ.
    weighted: Vec<Complex64>,
}

impl CurveFields {
    /// Room for one state.
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let (size, modes) = (layout.fields() * layout.nodes(), grid.modes());
        let spectra = vec![Complex64::default(); layout.fields() * modes];
        let graded = |grading: &Arc<Grading>| {
            // A metric that moves is that of one state alone.
            let grading =
                if layout.metric().is_some() { Arc::new(Grading::clone(grading)) } else { grading.clone() };
            Graded { grading, weighted: spectra.clone() }
        };
        Self {
            layout,
            modes,
            length: 1.0,
            pointwise: vec![0.0; size],
            interpolated: derivative.interpolation().map(|_| vec![0.0; size]),
            graded: derivative.grading().map(graded),
            spectra,
            scratch: vec![Complex64::default(); modes],
        }
    }

    /// Takes the fields from a spectral state vector.
    ///
    /// # Panics
    /// If it is none of the layout.
    #[track_caller]
    pub fn set(&mut self, state: &[f64], grid: &mut PeriodicGrid, derivative: &Derivative) {
        let layout = SpectralLayout::new(self.layout);
        layout.check(state);
        self.length = state[layout.length_index()];
        if let (Some(field), Some(graded), Some(interpolation)) =
            (self.layout.metric(), &mut self.graded, derivative.interpolation())
        {
            let metric = &layout.spectra(state)[self.layout.spectrum(field)];
            self.length = metric[0].re;
            Arc::make_mut(&mut graded.grading).set(metric, interpolation, grid, &mut self.scratch);
        }
        let target = self.graded.as_mut().map_or(&mut self.spectra, |graded| &mut graded.weighted);
        let fields = &state[..2 * self.layout.fields() * self.modes];
        scale_into(bytemuck::cast_slice_mut(target), 1.0 / self.length, fields);
        for field in 0..self.layout.fields() {
            let range = self.layout.field(field);
            let modes = self.layout.spectrum(field);
            let values = &mut self.pointwise[range.clone()];
            if let Some(Graded { grading, weighted }) = &self.graded {
                grid.synthesise(&weighted[modes.clone()], values);
                multiply(values, grading.inverse());
                grid.transform(values, &mut self.spectra[modes.clone()]);
            } else {
                grid.synthesise(&self.spectra[modes.clone()], values);
            }
            if let (Some(symbol), Some(values)) = (derivative.interpolation(), &mut self.interpolated) {
                apply_symbol(&mut self.scratch, &self.spectra[modes], symbol);
                grid.synthesise(&self.scratch, &mut values[range]);
            }
        }
    }

    /// Shape of the state.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Length |Γ|; the metric is |Γ|w.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The metric w per length; none if it is uniform.
    #[must_use]
    pub fn grading(&self) -> Option<&Grading> {
        self.graded.as_ref().map(|graded| &*graded.grading)
    }

    /// The metric per length, if it is a field of the state.
    #[must_use]
    pub fn moving_metric(&self) -> Option<&Grading> {
        self.grading().filter(|_| self.layout.metric().is_some())
    }

    /// Index of the metric among the fields of the state, and the metric per length: for what is made for states that hold it.
    ///
    /// # Panics
    /// If the state does not hold it.
    #[must_use]
    pub fn metric_field(&self) -> (usize, &Grading) {
        self.layout.metric().zip(self.grading()).expect("the metric is a field of the state")
    }

    /// The weights w of the nodes; none if all are 1.
    #[must_use]
    pub fn weight(&self) -> Option<&[f64]> {
        self.graded.as_ref().map(|graded| graded.grading.weight())
    }

    /// Mean of nodal values over the curve.
    #[must_use]
    pub fn mean(&self, values: &[f64]) -> f64 {
        self.weight().map_or_else(|| mean(values), |weight| mean_of_product(weight, values))
    }

    /// Mean over the curve of the products of nodal values.
    #[must_use]
    pub fn mean_of_product(&self, a: &[f64], b: &[f64]) -> f64 {
        self.weight().map_or_else(|| mean_of_product(a, b), |weight| mean_of_triple_product(weight, a, b))
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
        &self.spectra[self.layout.spectrum(field)]
    }

    /// Fourier coefficients of w times field `field`: of the state per length.
    #[must_use]
    pub fn weighted_spectrum(&self, field: usize) -> &[Complex64] {
        let spectra = self.graded.as_ref().map_or(&self.spectra, |graded| &graded.weighted);
        &spectra[self.layout.spectrum(field)]
    }
}

/// Panics unless states, grid and derivative are those of the same nodes.
#[track_caller]
pub(super) fn check_nodes(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) {
    let nodes = [layout.nodes(), grid.nodes(), derivative.nodes()];
    assert!(
        nodes.iter().all(|count| *count == nodes[0]),
        "states, grid and derivative have as many nodes, not {nodes:?}"
    );
}
