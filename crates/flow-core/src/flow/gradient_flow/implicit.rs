//! The implicit operator −𝓚 Hess `𝓕_h`, and the tension in it. See `THEORY.md`, eqs. (F7) and (F20).

use multiversion::multiversion;

use super::GradientFlow;
use crate::flow::curve_fields::CurveFields;
use crate::flow::normal_mobility::{MobilityError, NormalMobility};
use crate::geometry::SpectralLayout;
use crate::geometry::vectors::mean;

impl GradientFlow {
    /// Product of the frozen −𝓚 Hess `𝓕_h` with `v`, both spectral.
    pub fn spectral_jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.descend(true);
        self.write_rates(true, out);
    }

    /// Product of the implicit operator with the spectral `v`: −𝓚 Hess `𝓕_h` at the linearisation, and what the tension there
    /// does to a change of the curvature.
    pub fn implicit_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.map.force(&self.frozen, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
        self.add_tension(v);
        let mobility = self.frozen_mobility.as_mut();
        drive(mobility, self.frozen_fault, &self.frozen, &self.force, &mut self.velocity);
        self.write_rates(true, out);
    }

    /// Takes the tension at the linearisation; none where the energy depends on positions, see (F20).
    pub(super) fn freeze_tension(&mut self) {
        if self.energy.depends_on_positions() {
            return self.frozen_stretching.fill(0.0);
        }
        let (spectra, by_length) = (&self.gradient.spectra, self.gradient.by_length);
        self.map.stretching(&self.frozen, spectra, by_length, &mut self.frozen_stretching);
    }

    /// Adds (Z − π)δκ to the force, with κ = K/(|Γ|w), or K/g where the metric is a field.
    fn add_tension(&mut self, v: &[f64]) {
        let layout = SpectralLayout::new(self.layout);
        let (modes, length) = (layout.modes(), self.frozen.length());
        let change = &mut self.velocity;
        let (grid, _) = self.map.grid_and_derivative();
        grid.synthesise(&layout.spectra(v)[..modes], change);
        let Some(weight) = self.frozen.weight() else {
            let kappa = self.frozen.at_nodes(0);
            let length_motion = v[layout.length_index()];
            return add_uniform_tension(
                &mut self.force,
                &self.frozen_stretching,
                [change, kappa],
                length_motion,
                1.0 / length,
            );
        };
        let by_weight = |i: usize| 1.0 / (length * weight[i]);
        for (i, force) in self.force.iter_mut().enumerate() {
            *force += self.frozen_stretching[i] * change[i] * by_weight(i);
        }
        match self.layout.metric() {
            None => change.fill(v[layout.length_index()]),
            Some(field) => grid.synthesise(&layout.spectra(v)[field * modes..(field + 1) * modes], change),
        }
        let stretched = |i: usize| if self.layout.metric().is_some() { by_weight(i) } else { 1.0 / length };
        let kappa = self.frozen.at_nodes(0);
        for (i, force) in self.force.iter_mut().enumerate() {
            *force -= self.frozen_stretching[i] * kappa[i] * change[i] * stretched(i);
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

/// f += (Z − π)(δK − κ δ|Γ|)/|Γ|, with 1/|Γ| = `inverse`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_uniform_tension(
    force: &mut [f64],
    stretching: &[f64],
    [turning_motion, kappa]: [&[f64]; 2],
    length_motion: f64,
    inverse: f64,
) {
    for (((f, stretching), change), kappa) in force.iter_mut().zip(stretching).zip(turning_motion).zip(kappa)
    {
        *f += stretching * change * inverse;
        *f -= stretching * kappa * length_motion * inverse;
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
