//! The co-moving gauge W = 0: every node moves along the normal, and the metric g is a field. See `THEORY.md`, eq. (F19).

use super::{Gauge, MetricRole, Workspace};
use crate::flow::CurveFields;
use crate::geometry::Complex64;
use crate::geometry::vectors::{multiply, multiply_into, scale};

/// W = 0: nodes are material points, which move along the normal, and the metric g is a field of the state. See `THEORY.md`, eq. (F19).
#[derive(Clone, Copy, Debug, Default)]
pub struct CoMoving;

impl Gauge for CoMoving {
    fn metric(&self) -> MetricRole {
        MetricRole::Field
    }

    /// g ↦ gκV; what the nodes carry stays.
    fn rates(&self, work: &mut Workspace, at: &CurveFields, v: &[f64], rates: &mut [Complex64]) -> f64 {
        rates.fill(Complex64::default());
        let ((field, metric), length) = (at.metric_field(), at.length());
        multiply_into(&mut work.product, at.at_nodes(0), v);
        multiply(&mut work.product, metric.weight());
        scale(&mut work.product, length);
        let stretch = &mut rates[work.layout.spectrum(field)];
        work.grid.transform(&work.product, stretch);
        stretch[0].re
    }

    /// −∂𝓕/∂g.
    fn stretching(
        &self,
        work: &mut Workspace,
        at: &CurveFields,
        gradient: &[Complex64],
        by_length: f64,
        out: &mut [f64],
    ) {
        let (field, _) = at.metric_field();
        work.spectrum.copy_from_slice(&gradient[work.layout.spectrum(field)]);
        work.grid.synthesise(&work.spectrum, out);
        for value in out {
            *value = -*value - by_length;
        }
    }

    fn tangential_velocity(&self, _: &mut Workspace, _: &CurveFields, _: &[f64], w: &mut [f64]) {
        w.fill(0.0);
    }
}
