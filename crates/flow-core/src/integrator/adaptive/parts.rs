//! What a loop holds, to read.

use super::{Adaptive, AdaptiveOptions};
use crate::integrator::{Counters, EnergyScale, INTEGRALS, Rest, Stepper};

impl<S: Stepper> Adaptive<S> {
    /// The watch over the energy.
    #[must_use]
    pub fn rest(&self) -> Rest {
        self.rest
    }

    /// The stepper.
    #[must_use]
    pub fn stepper(&self) -> &S {
        &self.stepper
    }

    /// Lets the steps end at `end` at the latest.
    pub fn set_end(&mut self, end: f64) {
        self.options.end = end;
    }

    /// Energy of the last accepted state.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// What errors of the energy are relative to.
    #[must_use]
    pub fn energy_scale(&self) -> EnergyScale {
        self.scale
    }

    /// The settings.
    #[must_use]
    pub fn options(&self) -> &AdaptiveOptions {
        &self.options
    }

    /// Work so far.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// The integrals carried along.
    #[must_use]
    pub fn integrals(&self) -> [f64; INTEGRALS] {
        self.stepper.integrals()
    }

    /// The last candidate, also after a step that failed.
    pub fn candidate(&mut self) -> &[f64] {
        self.stepper.candidate()
    }
}
