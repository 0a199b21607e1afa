//! The operator −𝓚 Hess `𝓕_h`, and with the tension the implicit one. See `THEORY.md`, eqs. (F7), (F20) and (F21).

use super::{Descent, GradientFlow};
use crate::geometry::vectors::{add_product, mean};

impl GradientFlow {
    /// Product of the frozen −𝓚 Hess `𝓕_h` with `v`, both spectral.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn spectral_jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.descent.descend(&mut self.frozen);
        self.descent.write_rates(&self.frozen.fields, out);
    }

    /// Product of the implicit operator with the spectral `v`: −𝓚 Hess `𝓕_h` at the linearisation, and what the tension there
    /// does to a change of the curvature.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn implicit_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.descent.set_force(&self.frozen.fields);
        self.add_tension();
        self.drive_frozen();
        self.descent.write_rates(&self.frozen.fields, out);
    }

    /// Velocity at the linearisation, in exchange for the force at hand.
    pub(super) fn drive_frozen(&mut self) {
        let Descent { force, velocity, .. } = &mut self.descent;
        if self.frozen.mobility.is_identity() {
            std::mem::swap(force, velocity);
        } else {
            self.frozen.drive(force, velocity);
        }
    }

    /// Takes the tension at the linearisation; none where the energy depends on positions, see (F20); its mean is left out
    /// where the length is held, see (F21).
    pub(super) fn freeze_tension(&mut self) {
        if self.energy.depends_on_positions() {
            return self.frozen_stretching.fill(0.0);
        }
        let Descent { map, gradient, .. } = &mut self.descent;
        let (fields, stretching) = (&self.frozen.fields, &mut self.frozen_stretching);
        map.stretching(fields, &gradient.spectra, gradient.by_length, stretching);
        if self.frozen.mobility.keeps().length {
            // 𝓑 takes κ to zero on every curve: a mean tension moves nothing, and its derivative is not that of the force alone.
            let mean = fields.mean(stretching);
            for value in stretching {
                *value -= mean;
            }
        }
    }

    /// Where the area is held, 𝓚 takes its gradient to zero: the second derivative is that of the energy less the force that holds
    /// it, see (F21).
    pub(super) fn hold_area(&mut self) {
        if self.frozen.mobility.keeps().area && self.energy.depends_on_positions() {
            self.descent.set_force(&self.frozen.fields);
            let multiplier = self.frozen.mobility.area_multiplier(&self.frozen.fields, &self.descent.force);
            self.energy.hold_area(multiplier);
        }
    }

    /// Adds (Z − π)δκ to the force, δκ that of the last product of the second derivative.
    fn add_tension(&mut self) {
        if !self.energy.depends_on_positions() {
            add_product(&mut self.descent.force, &self.frozen_stretching, self.energy.curvature_motion());
        }
    }

    /// Z − ⟨wZ⟩ − π at the linearisation, minus the tension of the curve there, one value per node; zero where the energy depends
    /// on positions.
    #[must_use]
    pub fn frozen_stretching(&self) -> &[f64] {
        &self.frozen_stretching
    }

    /// Mean tension of the curve at the linearisation; negative where it is compressed.
    #[must_use]
    pub fn mean_tension(&self) -> f64 {
        -mean(&self.frozen_stretching)
    }
}
