//! A gauge that the library does not have: the nodes are carried a part α of the way to where they keep their fractions of the
//! arc length. α = 0 is the co-moving gauge, α = 1 the graded one with its metric as a field.

use flow_core::flow::{CoMoving, CurveFields, Gauge, MetricRole, Workspace};
use flow_core::geometry::Complex64;
use flow_core::geometry::vectors::{
    apply_symbol, mean_of_product, multiply_by, multiply_by_conjugate, multiply_into,
};

/// W = `α𝒯V`, 𝒯 that of the graded gauge.
#[derive(Clone, Copy, Debug)]
pub struct Partly(pub f64);

impl Partly {
    /// |Γ|w(κV − mean), the stretching that is undone, into `work.product`.
    fn uneven_stretch(work: &mut Workspace, at: &CurveFields, v: &[f64]) {
        let weight = at.weight().expect("a metric");
        multiply_into(&mut work.product, at.at_nodes(0), v);
        let mean = mean_of_product(weight, &work.product);
        for (product, weight) in work.product.iter_mut().zip(weight) {
            *product = at.length() * weight * (*product - mean);
        }
    }
}

impl Gauge for Partly {
    fn metric(&self) -> MetricRole {
        MetricRole::Field
    }

    fn rates(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        let (modes, metric) = (work.grid.modes(), work.layout.metric().expect("a metric"));
        let length_rate = CoMoving.rates(work, at, v, rates);
        Self::uneven_stretch(work, at, v);
        work.grid.transform(&work.product, &mut work.spectrum);
        let stretch = &mut rates[metric * modes..(metric + 1) * modes];
        for (stretch, undone) in stretch.iter_mut().zip(&work.spectrum) {
            *stretch -= undone * self.0;
        }
        multiply_by_conjugate(&mut work.spectrum, self.0, work.derivative.inverse_to_flux());
        work.grid.synthesise(&work.spectrum, &mut work.tangential);
        work.transport(at, rates);
        length_rate
    }

    fn stretching(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        gradient: &[Complex64],
        by_length: f64,
        out: &mut [f64],
    ) {
        let (modes, metric) = (work.grid.modes(), work.layout.metric().expect("a metric"));
        CoMoving.stretching(work, at, gradient, by_length, out);
        // z = Σ φ ∂_s p over the fields, the metric among them with φ = 1; then the mean-free part of D₊⁻¹z.
        work.transport_transposed(at, gradient);
        work.grid.transform(&work.product, &mut work.spectrum);
        let mut image = vec![Complex64::default(); modes];
        apply_symbol(&mut image, &gradient[metric * modes..(metric + 1) * modes], work.derivative.to_flux());
        work.spectrum.iter_mut().zip(&image).for_each(|(z, image)| *z += image);
        multiply_by(&mut work.spectrum, work.derivative.inverse_to_flux());
        work.grid.synthesise(&work.spectrum, &mut work.values);
        let mean = mean_of_product(at.weight().expect("a metric"), &work.values);
        for (out, z) in out.iter_mut().zip(&work.values) {
            *out += self.0 * (z - mean);
        }
    }

    fn tangential_velocity(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], w: &mut [f64]) {
        Self::uneven_stretch(work, at, v);
        work.product.iter_mut().for_each(|stretch| *stretch *= -self.0);
        work.grid.transform(&work.product, &mut work.spectrum);
        work.grid.integrate(&mut work.spectrum);
        work.grid.synthesise(&work.spectrum, w);
    }
}
