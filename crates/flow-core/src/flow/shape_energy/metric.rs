//! The derivatives by the metric, where that is a field. See `THEORY.md`, eq. (D10).

use super::super::intrinsic_gradient::IntrinsicGradient;
use super::ShapeEnergy;
use crate::energies::Order;
use crate::geometry::vectors::{add_scaled, mean_of_product};

impl ShapeEnergy {
    /// The derivative by g: that by L at fixed w, and with ω = ∂𝓕/∂w the rest (ω − ⟨wω⟩)/L. The part along the tangents is in
    /// `values`.
    pub(super) fn pull_back_to_metric(
        &mut self,
        field: usize,
        order: Order,
        gradient: &mut IntrinsicGradient,
    ) {
        let (weight, length) = (&self.shape.weight, self.shape.length);
        for ((by_weight, along), weight) in self.dual.weight.iter_mut().zip(&self.values).zip(weight) {
            *by_weight += along / weight;
        }
        let mean = mean_of_product(&self.dual.weight, weight);
        if order >= Order::Hessian {
            add_scaled(&mut self.frozen.by_weight, 1.0, &self.dual.weight);
            self.frozen.mean_by_weight += mean;
        }
        for (value, by_weight) in self.values.iter_mut().zip(&self.dual.weight) {
            *value = gradient.by_length + (by_weight - mean) / length;
        }
        gradient.by_length = 0.0;
        self.add_to_metric(field, gradient);
    }

    /// Change of the derivative by g, with that by L in `out`; the motion of the tangent angle is still in `angle`.
    pub(super) fn move_by_metric(&mut self, field: usize, shortening: f64, out: &mut IntrinsicGradient) {
        let (frozen, motion, length) = (&self.frozen, &self.motion, self.frozen.shape.length);
        let ([c, s], [by_x, by_y]) = (frozen.shape.tangents(), self.dual.tangents());
        let mut mean = 0.0;
        for i in 0..self.values.len() {
            let (weight, change) = (frozen.shape.weight[i], motion.weight[i]);
            let along = frozen.along_tangent[i];
            let turned = self.angle[i] * frozen.across_tangent[i] + c[i] * by_x[i] + s[i] * by_y[i];
            self.values[i] = self.dual.weight[i] + (turned + shortening * along) / weight;
            mean += weight * self.values[i] + change * frozen.by_weight[i];
        }
        mean /= self.values.len() as f64;
        let shrink = motion.length / length;
        for (value, by_weight) in self.values.iter_mut().zip(&frozen.by_weight) {
            *value = out.by_length + (*value - mean - shrink * (by_weight - frozen.mean_by_weight)) / length;
        }
        out.by_length = 0.0;
        self.add_to_metric(field, out);
    }

    fn add_to_metric(&mut self, field: usize, out: &mut IntrinsicGradient) {
        self.grid.transform(&self.values, &mut self.spectrum);
        let by_metric = &mut out.spectra[self.layout.spectrum(field)];
        by_metric.iter_mut().zip(&self.spectrum).for_each(|(sum, value)| *sum += value);
    }
}
