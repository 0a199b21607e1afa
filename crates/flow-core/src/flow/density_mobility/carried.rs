//! A density that is only carried along: 𝓖 = 0. See `THEORY.md`, eq. (F16).

use super::DensityMobility;
use crate::flow::CurveFields;
use crate::geometry::Complex64;

/// 𝓖 = 0: the density is carried along, and every labelled segment keeps its mass. See `THEORY.md`, eq. (F16).
#[derive(Clone, Copy, Debug, Default)]
pub struct Carried;

impl DensityMobility for Carried {
    fn is_zero(&self) -> bool {
        true
    }

    fn apply(&mut self, _: &CurveFields, _: &[Complex64], out: &mut [Complex64]) {
        out.fill(Complex64::default());
    }

    fn symbol(&self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn order(&self) -> usize {
        0
    }

    fn three_points(&self, _: &CurveFields, _: usize, _: usize) -> [f64; 3] {
        [0.0; 3]
    }

    fn conserves_mass(&self) -> bool {
        true
    }
}
