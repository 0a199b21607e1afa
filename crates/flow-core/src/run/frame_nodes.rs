//! Frames on other nodes.

use super::record::Frame;
use crate::geometry::{Complex64, Grading, PeriodicGrid, ScatteredPoints, resample};

/// Spread of the metric, relative to the length, that is rounding.
const UNIFORM: f64 = 1e-12;

impl Frame {
    /// Whether it holds as many values and fields of each kind as `other`, and every field a value for each of its own nodes.
    pub(super) fn is_shaped_like(&self, other: &Self) -> bool {
        let counts = |frame: &Self| {
            [&frame.energy_terms, &frame.mass, &frame.diagnostics]
                .map(Vec::len)
                .into_iter()
                .chain([frame.density.len(), frame.fields.len()])
                .collect::<Vec<_>>()
        };
        let nodes = self.nodes();
        let whole = self.position.len() == nodes && self.nodal_fields().all(|field| field.len() == nodes);
        nodes >= 2 && whole && counts(self) == counts(other)
    }

    /// Number of its nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.curvature.len()
    }

    /// Every field that has one value per node: curvature, metric, normal velocity, densities, and those that the scene asks for.
    pub fn nodal_fields(&self) -> impl Iterator<Item = &Vec<f64>> {
        [&self.curvature, &self.metric, &self.normal_velocity]
            .into_iter()
            .chain(&self.density)
            .chain(&self.fields)
    }

    /// The same frame on `nodes` nodes at the same parameters s, by trigonometric interpolation.
    #[must_use]
    pub fn resampled(self, nodes: usize) -> Self {
        if nodes == self.nodes() { self } else { self.map(|values| resample(values, nodes)) }
    }

    /// Whether its nodes are at equal distances.
    pub(super) fn is_uniform(&self) -> bool {
        self.metric.iter().all(|g| (g - self.length).abs() <= UNIFORM * self.length)
    }

    /// Fractions of the arc length at its nodes, from the first on; none if the metric is not positive everywhere.
    pub(super) fn fractions(&self) -> Option<Vec<f64>> {
        Some(self.grading()?.fractions())
    }

    /// The same frame at other `fractions` of the arc length; none if the metric is not positive everywhere.
    pub(super) fn at_fractions(self, fractions: &[f64]) -> Option<Self> {
        let mut points = ScatteredPoints::at_fractions(&self.grading()?, fractions);
        let mut grid = PeriodicGrid::new(self.nodes());
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        Some(self.map(|values| {
            grid.transform(values, &mut spectrum);
            points.values(&spectrum)
        }))
    }

    fn grading(&self) -> Option<Grading> {
        Grading::new(&resample(&self.metric, Grading::samples(self.metric.len()))).ok()
    }

    /// Every field by `change`.
    fn map(mut self, mut change: impl FnMut(&[f64]) -> Vec<f64>) -> Self {
        let [x, y] = [0, 1].map(|axis| change(&self.position.iter().map(|at| at[axis]).collect::<Vec<_>>()));
        self.position = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
        let nodal = [&mut self.curvature, &mut self.metric, &mut self.normal_velocity];
        let fields = nodal.into_iter().chain(&mut self.density).chain(&mut self.fields);
        for field in fields.filter(|field| !field.is_empty()) {
            *field = change(field);
        }
        self
    }
}
