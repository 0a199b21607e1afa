//! From derivatives by positions and tangents to those by curvature, length and metric, by the transpose of the embedding.

use super::ShapeEnergy;
use crate::energies::Order;
use crate::flow::intrinsic_gradient::IntrinsicGradient;
use crate::geometry::vectors::{add_scaled, mean, mean_of_product};

impl ShapeEnergy {
    /// Adds what the derivatives by positions and tangents are by K, the length and the metric; for a linearisation keeps them, with
    /// those before.
    pub(super) fn pull_back(&mut self, order: Order, gradient: &mut IntrinsicGradient) {
        let length = self.shape.length;
        for axis in 0..2 {
            gradient.by_length +=
                mean_of_product(&self.dual.position[axis], &self.shape.position[axis]) / length;
            self.pull_back_to_tangent(axis, length);
        }
        gradient.by_length += self.dual.length;
        let ([c, s], [by_x, by_y]) = (self.shape.tangents(), self.dual.tangents());
        for (i, angle) in self.angle.iter_mut().enumerate() {
            *angle = c[i] * by_y[i] - s[i] * by_x[i];
        }
        for (i, along) in self.values.iter_mut().enumerate() {
            *along = c[i] * by_x[i] + s[i] * by_y[i];
        }
        if order >= Order::Hessian {
            for axis in 0..2 {
                add_scaled(&mut self.frozen.by_position[axis], 1.0, &self.dual.position[axis]);
            }
            add_scaled(&mut self.frozen.along_tangent, 1.0, &self.values);
            add_scaled(&mut self.frozen.across_tangent, 1.0, &self.angle);
        }
        if let Some(sawtooth) = self.sawtooth {
            gradient.spectra[sawtooth.mode].re += sawtooth.first() * mean(&self.values);
        }
        if let Some(field) = self.metric {
            self.pull_back_to_metric(field, order, gradient);
        }
        self.pull_back_to_turning(gradient);
    }

    /// Derivative by tangents += (LP)ᵀ derivative by positions = −LP derivative by positions.
    pub(super) fn pull_back_to_tangent(&mut self, axis: usize, length: f64) {
        self.grid.transform(&self.dual.position[axis], &mut self.spectrum);
        self.grid.integrate(&mut self.spectrum);
        self.grid.synthesise(&self.spectrum, &mut self.values);
        for (tangent, value) in self.dual.tangent[axis].iter_mut().zip(&self.values) {
            *tangent -= length * value;
        }
    }

    /// p += (P + s⟨·⟩)ᵀ `angle`.
    pub(super) fn pull_back_to_turning(&mut self, out: &mut IntrinsicGradient) {
        let nodes = self.angle.len() as f64;
        self.grid.transform(&self.angle, &mut self.spectrum);
        self.grid.integrate(&mut self.spectrum);
        out.spectra.iter_mut().zip(&self.spectrum).for_each(|(p, value)| *p -= value);
        for (i, value) in self.values.iter_mut().enumerate() {
            *value = self.angle[i] * i as f64 / nodes;
        }
        out.spectra[0].re += mean(&self.values);
    }
}
