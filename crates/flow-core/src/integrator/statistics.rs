//! Counters of work and of rejected attempts.

use serde::{Deserialize, Serialize};

/// Why an attempt at a step failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejection {
    /// The local error was above the tolerance, or the dissipation did not account for the energy lost.
    Error,
    /// The implicit solve did not converge.
    Solver,
    /// The energy rose.
    EnergyRise,
    /// A value was NaN or infinite.
    NotFinite,
}

/// Attempts at a step that were thrown away, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejections {
    /// The local error was above the tolerance, or the dissipation did not account for the energy lost.
    pub error: u64,
    /// The implicit solve did not converge.
    pub solver: u64,
    /// The energy rose by more than rounding.
    pub energy_rise: u64,
    /// A value was NaN or infinite.
    pub not_finite: u64,
}

impl Rejections {
    /// All rejections.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.error + self.solver + self.energy_rise + self.not_finite
    }

    /// Counts one rejection.
    pub fn count(&mut self, cause: Rejection) {
        *match cause {
            Rejection::Error => &mut self.error,
            Rejection::Solver => &mut self.solver,
            Rejection::EnergyRise => &mut self.energy_rise,
            Rejection::NotFinite => &mut self.not_finite,
        } += 1;
    }
}

/// Work done and time spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected attempts, by cause.
    pub rejections: Rejections,
    /// Evaluations of the right-hand side −`𝓚∇𝓕_h`.
    pub right_hand_sides: u64,
    /// Products of the implicit operator −𝓚 Hess `𝓕_h` with a vector.
    pub jacobian_products: u64,
    /// Newton iterations.
    pub newton_iterations: u64,
    /// Krylov iterations.
    pub krylov_iterations: u64,
    /// Factorisations of the preconditioner or of the implicit matrix.
    pub factorisations: u64,
    /// Solves with such a factorisation.
    pub solves: u64,
    /// Changes of the nodes or of the gauge.
    pub remaps: u64,
    /// Steps whose state the nodes chosen by the program do not resolve to the tolerance, and no others could be had.
    pub unresolved_steps: u64,
    /// Seconds spent in the time integration, without start-up and output.
    pub integration_seconds: f64,
}
