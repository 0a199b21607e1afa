//! The operator −𝓚 Hess `𝓕_h`, and with the tension the implicit one. See `THEORY.md`, eqs. (F7) and (F20).

use super::{Descent, GradientFlow};

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

    /// Product of the implicit operator with the spectral `v`: −𝓚 Hess `𝓕_h` at the linearisation, what the tension there does to a
    /// change of the curvature, and the transport of densities that are only carried along.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn implicit_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.implicit_velocity(v);
        self.descent.write_rates(&self.frozen.fields, out);
        self.add_sliding(out);
    }

    /// The normal velocity of that product, at [`GradientFlow::normal_velocity`], and the gradient that goes with it.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub(in crate::flow) fn implicit_velocity(&mut self, v: &[f64]) {
        self.spectral_hessian_product(v);
        self.descent.set_force(&self.frozen.fields);
        self.add_tension();
        self.drive_frozen();
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
}
