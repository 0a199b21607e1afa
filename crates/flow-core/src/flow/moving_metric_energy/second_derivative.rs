//! The second derivative.

use super::super::curve_fields::CurveFields;
use super::super::intrinsic_gradient::IntrinsicGradient;
use super::MovingMetricEnergy;
use crate::energies::{Jet, LengthJet};
use crate::geometry::vectors::{add_product, add_scaled, apply_symbol, multiply, multiply_into, scale};
use crate::geometry::{Complex64, Grading};

impl MovingMetricEnergy {
    /// Motion of the pointwise fields under the motion of the last [`MovingMetricEnergy::hessian_product`], one after the other.
    pub fn motion(&self) -> &[f64] {
        &self.motion
    }

    /// Second derivative times the motion of the fields Φ = K, m and the metric, given by their spectra, at the fields `at` of
    /// the linearisation, where the nodal density has the second derivatives in `jet`.
    pub fn hessian_product(
        &mut self,
        jet: &Jet,
        of_length: LengthJet,
        at: &CurveFields,
        motion: &[Complex64],
        out: &mut IntrinsicGradient,
    ) {
        let (place, metric) = at.metric_field();
        let (fields, length) = (self.layout.fields(), at.length());
        let of_metric = &motion[self.layout.spectrum(place)];
        self.grid.synthesise(of_metric, &mut self.metric_motion[0]);
        apply_symbol(&mut self.spectrum, of_metric, &self.interpolation);
        self.grid.synthesise(&self.spectrum, &mut self.metric_motion[1]);
        self.by_metric.fill(of_length.second * of_metric[0].re);
        for field in 0..fields {
            self.move_field(field, at, metric, &motion[self.layout.spectrum(field)]);
            let range = self.layout.field(field);
            add_product(&mut self.by_metric, &self.frozen_first[range.clone()], &self.motion[range]);
        }
        // δ∂E/∂(Mφ, slope) in `at_flux`.
        for variable in 0..2 * fields {
            let range = self.layout.field(variable);
            self.at_flux[range.clone()].fill(0.0);
            for other in 0..2 * fields {
                let moved = &self.motion_at_flux[self.layout.field(other)];
                add_product(&mut self.at_flux[range.clone()], self.flux_jet.second(variable, other), moved);
            }
        }
        self.product.fill(0.0);
        for field in 0..fields {
            let (range, slopes) = (self.layout.field(field), self.layout.field(fields + field));
            add_product(&mut self.product, &self.frozen_stress[range.clone()], &self.motion_at_flux[range]);
            let stress = self.at_flux[slopes.clone()].iter().zip(&self.frozen_at_flux[slopes]);
            self.product.iter_mut().zip(stress).for_each(|(q, (a, b))| *q -= a * b);
        }
        self.sum.fill(Complex64::default());
        self.add_interpolated();
        self.grid.synthesise(&self.sum, &mut self.values);
        add_scaled(&mut self.by_metric, 1.0, &self.values);
        for field in 0..fields {
            let range = self.layout.field(field);
            self.values.fill(0.0);
            for other in 0..fields {
                add_product(
                    &mut self.values,
                    jet.second(field, other),
                    &self.motion[self.layout.field(other)],
                );
            }
            multiply(&mut self.values, metric.weight());
            scale(&mut self.values, length);
            add_product(&mut self.values, &self.frozen_first[range.clone()], &self.metric_motion[0]);
            multiply_into(&mut self.product, &self.at_flux[range.clone()], metric.at_midpoints());
            scale(&mut self.product, length);
            add_product(&mut self.product, &self.frozen_stress[range.clone()], &self.metric_motion[1]);
            let stress = std::mem::take(&mut self.at_flux);
            self.sum_force(&stress[self.layout.field(fields + field)]);
            self.at_flux = stress;
            let potential = &self.frozen_potential[range.clone()];
            for ((value, p), g) in self.values.iter_mut().zip(potential).zip(&self.metric_motion[0]) {
                *value -= p * g;
            }
            self.divide_by_metric(metric, length);
            let potential = self.frozen_potential[range.clone()].iter().zip(&self.motion[range]);
            let fields = at.at_nodes(field).iter().zip(&self.values);
            for ((q, (p, change)), (phi, p_change)) in self.by_metric.iter_mut().zip(potential).zip(fields) {
                *q -= p * change + phi * p_change;
            }
            self.grid.transform(&self.values, &mut out.spectra[self.layout.spectrum(field)]);
        }
        self.grid.transform(&self.by_metric, &mut out.spectra[self.layout.spectrum(place)]);
        out.by_length = 0.0;
    }

    /// Motion of the pointwise field φ = Φ/g, of Mφ and of the slope, for the motion of Φ with the spectrum `motion`.
    fn move_field(&mut self, field: usize, at: &CurveFields, metric: &Grading, motion: &[Complex64]) {
        let (range, fields, inverse_length) =
            (self.layout.field(field), self.layout.fields(), 1.0 / at.length());
        let moved = &mut self.motion[range.clone()];
        self.grid.synthesise(motion, moved);
        for ((moved, phi), g) in moved.iter_mut().zip(at.at_nodes(field)).zip(&self.metric_motion[0]) {
            *moved -= phi * g;
        }
        multiply(moved, metric.inverse());
        scale(moved, inverse_length);
        self.grid.transform(moved, &mut self.sum);
        apply_symbol(&mut self.spectrum, &self.sum, &self.interpolation);
        self.grid.synthesise(&self.spectrum, &mut self.motion_at_flux[range]);
        apply_symbol(&mut self.spectrum, &self.sum, &self.to_flux);
        let slopes = self.layout.field(fields + field);
        let moved = &mut self.motion_at_flux[slopes.clone()];
        self.grid.synthesise(&self.spectrum, moved);
        for ((moved, slope), g) in
            moved.iter_mut().zip(&self.frozen_at_flux[slopes]).zip(&self.metric_motion[1])
        {
            *moved -= slope * g;
        }
        multiply(moved, metric.inverse_at_midpoints());
        scale(moved, inverse_length);
    }
}
