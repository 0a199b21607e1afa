//! The state of a curve as one flat vector.
//!
//! `[K₀ … Kₙ₋₁ | m¹₀ … | m²₀ … | L]` with K = κg (turning per unit parameter), mʲ = ρʲg (mass per unit parameter) and
//! L = |Γ|; a metric g that is a field of the state stands before L. On uniform nodes g = |Γ|, on graded ones |Γ|w. Turning
//! number and masses are sums of the vector, so that every linear method keeps them to rounding. See `THEORY.md`, eq. (D2).

use std::ops::Range;

/// Shape of the state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    nodes: usize,
    densities: usize,
    /// Whether the metric g is a field of the state, after the densities.
    moving_metric: bool,
}

impl Layout {
    /// `nodes` nodes and `densities` densities.
    #[must_use]
    pub fn new(nodes: usize, densities: usize) -> Self {
        Self { nodes, densities, moving_metric: false }
    }

    /// The same with the metric g as a field of the state, after the densities: `[K | m¹ | … | g | L]`, L the mean of g.
    #[must_use]
    pub fn with_metric(self) -> Self {
        Self { moving_metric: true, ..self }
    }

    /// Index of the metric among the fields, if the state holds it.
    #[must_use]
    pub fn metric(&self) -> Option<usize> {
        self.moving_metric.then_some(1 + self.densities)
    }

    /// Number of fields that the state vector holds.
    #[must_use]
    pub fn state_fields(&self) -> usize {
        self.fields() + usize::from(self.moving_metric)
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of densities.
    #[must_use]
    pub fn densities(&self) -> usize {
        self.densities
    }

    /// Number of nodal fields: the curvature and the densities.
    #[must_use]
    pub fn fields(&self) -> usize {
        1 + self.densities
    }

    /// Number of Fourier coefficients of a field.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.nodes / 2 + 1
    }

    /// The coefficients of field `field` where the spectra of all fields stand one after the other.
    #[must_use]
    pub fn spectrum(&self, field: usize) -> Range<usize> {
        field * self.modes()..(field + 1) * self.modes()
    }

    /// Length of the state vector.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length_index() + 1
    }

    /// Whether the state is empty: never.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Index of the length |Γ| in the state vector.
    #[must_use]
    pub fn length_index(&self) -> usize {
        self.state_fields() * self.nodes
    }

    /// Entries of field `field` (0: curvature, then the densities).
    #[must_use]
    pub fn field(&self, field: usize) -> Range<usize> {
        field * self.nodes..(field + 1) * self.nodes
    }

    /// Panics unless `state` is as long as such a vector.
    #[track_caller]
    pub(super) fn check(&self, state: &[f64]) {
        assert_eq!(state.len(), self.len(), "length of a nodal vector; a spectral one is longer");
    }

    /// State vector of pointwise `curvature` and `density` on a curve of the given length with uniform metric.
    ///
    /// # Panics
    /// If there is not one value per node and field.
    #[must_use]
    pub fn assemble(&self, curvature: &[f64], density: &[Vec<f64>], length: f64) -> Vec<f64> {
        let mut y = Vec::with_capacity(self.len());
        y.extend(curvature.iter().map(|kappa| kappa * length));
        for rho in density {
            y.extend(rho.iter().map(|rho| rho * length));
        }
        if self.moving_metric {
            y.extend(std::iter::repeat_n(length, self.nodes));
        }
        y.push(length);
        assert_eq!(y.len(), self.len(), "one value per node and field");
        y
    }
}

/// A state vector with its layout.
#[derive(Clone, Copy, Debug)]
pub struct StateRef<'a> {
    layout: Layout,
    values: &'a [f64],
}

impl<'a> StateRef<'a> {
    /// Wraps a state vector.
    ///
    /// # Panics
    /// If it has not the length that `layout` says.
    #[must_use]
    pub fn new(layout: Layout, values: &'a [f64]) -> Self {
        assert_eq!(values.len(), layout.len(), "length of the state vector");
        Self { layout, values }
    }

    /// Shape of the vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Length |Γ| of the curve: the mean of its metric g, and g itself on uniform nodes.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.values[self.layout.length_index()]
    }

    /// K = κg at the nodes.
    #[must_use]
    pub fn turning_per_parameter(&self) -> &'a [f64] {
        self.field_per_parameter(0)
    }

    /// Field `field` per unit parameter: K, m¹, m², …
    #[must_use]
    pub fn field_per_parameter(&self, field: usize) -> &'a [f64] {
        &self.values[self.layout.field(field)]
    }

    /// Pointwise field `field` on uniform nodes: κ, ρ¹, ρ², …; on others it is that times g/|Γ|.
    #[must_use]
    pub fn pointwise(&self, field: usize) -> Vec<f64> {
        let length = self.length();
        self.field_per_parameter(field).iter().map(|value| value / length).collect()
    }

    /// Mass ∫ρ dσ of density `density`.
    #[must_use]
    pub fn mass(&self, density: usize) -> f64 {
        self.field_per_parameter(1 + density).iter().sum::<f64>() / self.layout.nodes as f64
    }
}
