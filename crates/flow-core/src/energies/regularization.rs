//! Curvature regularisation (δ/2)∫|∇_sκ|² dσ. See `THEORY.md`, eq. (E2).

use super::EnergyTerm;

/// Penalty on curvature gradients.
#[derive(Clone, Debug)]
pub struct Regularization {
    delta: f64,
}

impl Regularization {
    /// Coefficient δ > 0, in energy × length³.
    #[must_use]
    pub fn new(delta: f64) -> Self {
        Self { delta }
    }
}

impl EnergyTerm for Regularization {
    fn name(&self) -> &'static str {
        "regularization"
    }

    fn stiffness(&self, field: usize) -> f64 {
        if field == 0 { self.delta } else { 0.0 }
    }
}
