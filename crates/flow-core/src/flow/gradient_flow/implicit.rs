//! The operator −𝓚 Hess `𝓕_h`, and with the tension the implicit one. See `THEORY.md`, eqs. (F7), (F20) and (F21).

use super::GradientFlow;
use crate::flow::curve_fields::CurveFields;
use crate::flow::normal_mobility::{MobilityError, NormalMobility};
use crate::geometry::vectors::{add_product, mean};

impl GradientFlow {
    /// Product of the frozen −𝓚 Hess `𝓕_h` with `v`, both spectral.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn spectral_jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.descend(true);
        self.write_rates(true, out);
    }

    /// Product of the implicit operator with the spectral `v`: −𝓚 Hess `𝓕_h` at the linearisation, and what the tension there
    /// does to a change of the curvature.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn implicit_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.map.force(&self.frozen, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
        self.add_tension();
        self.drive_frozen();
        self.write_rates(true, out);
    }

    /// Velocity at the linearisation, in exchange for the force at hand.
    pub(super) fn drive_frozen(&mut self) {
        if self.frozen_mobility.is_identity() {
            return std::mem::swap(&mut self.force, &mut self.velocity);
        }
        let mobility = self.frozen_mobility.as_mut();
        drive(mobility, self.frozen_fault, &self.frozen, &self.force, &mut self.velocity);
    }

    /// Takes the tension at the linearisation; none where the energy depends on positions, see (F20); its mean is left out
    /// where the length is held, see (F21).
    pub(super) fn freeze_tension(&mut self) {
        if self.energy.depends_on_positions() {
            return self.frozen_stretching.fill(0.0);
        }
        let (spectra, by_length) = (&self.gradient.spectra, self.gradient.by_length);
        self.map.stretching(&self.frozen, spectra, by_length, &mut self.frozen_stretching);
        if self.frozen_mobility.keeps().length {
            // 𝓑 takes κ to zero on every curve: a mean tension moves nothing, and its derivative is not that of the force alone.
            let mean = self.frozen.mean(&self.frozen_stretching);
            self.frozen_stretching.iter_mut().for_each(|stretching| *stretching -= mean);
        }
    }

    /// Where the area is held, 𝓚 takes its gradient to zero: the second derivative is that of the energy less the force that holds
    /// it, see (F21).
    pub(super) fn hold_area(&mut self) {
        if self.frozen_mobility.keeps().area && self.energy.depends_on_positions() {
            self.map.force(&self.frozen, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
            let multiplier = self.frozen_mobility.area_multiplier(&self.frozen, &self.force);
            self.energy.hold_area(multiplier);
        }
    }

    /// Adds (Z − π)δκ to the force, δκ that of the last product of the second derivative.
    fn add_tension(&mut self) {
        if !self.energy.depends_on_positions() {
            add_product(&mut self.force, &self.frozen_stretching, self.energy.curvature_motion());
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

/// V = 𝓑f, NaN where the mobility is not defined.
pub(super) fn drive(
    mobility: &mut dyn NormalMobility,
    fault: Option<MobilityError>,
    at: &CurveFields,
    force: &[f64],
    velocity: &mut [f64],
) {
    if fault.is_some() {
        velocity.fill(f64::NAN);
    } else {
        mobility.apply(at, force, velocity);
    }
}
