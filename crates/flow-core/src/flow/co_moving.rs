//! The co-moving gauge W = 0: every node moves along the normal, and the metric g is a field. See `THEORY.md`, eq. (F19).

use super::curve_fields::CurveFields;
use super::flow_map::FlowMap;
use crate::geometry::Complex64;
use crate::geometry::vectors::{add_scaled, multiply, multiply_into, scale};

impl FlowMap {
    /// Adds −(1/g)D₊ᵀ(1/Mg)D₊p, p the derivative by K.
    pub(super) fn add_co_moving_force(
        &mut self,
        at: &CurveFields,
        gradient: &[Complex64],
        force: &mut [f64],
    ) {
        let (Some(metric), Some(laplacian)) = (at.moving_metric(), &mut self.graded) else {
            return;
        };
        let modes = self.grid.modes();
        laplacian.follow(metric);
        laplacian.apply(&gradient[..modes], &mut self.spectrum);
        self.grid.synthesise(&self.spectrum, &mut self.values);
        multiply(&mut self.values, metric.inverse());
        add_scaled(force, -1.0 / at.length().powi(2), &self.values);
    }

    /// −∂𝓕/∂g.
    pub(super) fn co_moving_stretching(&mut self, gradient: &[Complex64], by_length: f64, out: &mut [f64]) {
        let Some(field) = self.layout.metric() else { return };
        let modes = self.grid.modes();
        self.spectrum.copy_from_slice(&gradient[field * modes..(field + 1) * modes]);
        self.grid.synthesise(&self.spectrum, out);
        for value in out {
            *value = -*value - by_length;
        }
    }

    /// K ↦ D₊ᵀ(1/Mg)D₊V, g ↦ KV; what the nodes carry stays.
    pub(super) fn co_moving_rates(&mut self, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        let (Some(metric), Some(laplacian), Some(field)) =
            (at.moving_metric(), &mut self.graded, self.layout.metric())
        else {
            return f64::NAN;
        };
        let (modes, length) = (self.grid.modes(), at.length());
        rates.fill(Complex64::default());
        self.grid.transform(v, &mut self.spectrum);
        laplacian.follow(metric);
        laplacian.apply(&self.spectrum, &mut self.image);
        for (rate, image) in rates.iter_mut().zip(&self.image) {
            *rate = image / length;
        }
        multiply_into(&mut self.product, at.at_nodes(0), v);
        multiply(&mut self.product, metric.weight());
        scale(&mut self.product, length);
        let stretch = &mut rates[field * modes..(field + 1) * modes];
        self.grid.transform(&self.product, stretch);
        stretch[0].re
    }
}
