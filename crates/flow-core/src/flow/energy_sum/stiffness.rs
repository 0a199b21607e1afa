//! What slopes cost: exactly, and on the mean for the preconditioners.

use super::EnergySum;

impl EnergySum {
    /// Coefficients of ½∫|∇_sφ|² dσ, by field.
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// [`EnergySum::stiffness`] and the mean of ∂²e′/∂(∇_sφ)² at the linearisation, unless it is negative: what the
    /// preconditioners hold of the terms of (D6).
    #[must_use]
    pub fn implicit_stiffness(&self) -> &[f64] {
        &self.implicit_stiffness
    }

    /// Takes the mean of the slopes' second derivatives at the state evaluated last.
    pub(super) fn freeze_stiffness(&mut self) {
        for (field, implicit) in self.implicit_stiffness.iter_mut().enumerate() {
            let of_slopes = match &self.moving {
                // With what the terms cost that need no expression.
                Some(moving) => moving.mean_stiffness(field) - self.stiffness[field],
                None => self.slopes.as_ref().map_or(0.0, |slopes| slopes.mean_stiffness(field)),
            };
            *implicit = self.stiffness[field] + of_slopes.max(0.0);
        }
    }
}
