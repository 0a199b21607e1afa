//! What is integrated: a right-hand side, its Jacobian, and what a finished step must know.

use std::ops::Range;

use super::integrals::{DISSIPATED, INTEGRALS};
use super::linear_part::LinearPart;

/// A system dy/dt = f(y) with an implicit operator I − γJ, J ≈ f′, along whose solutions an energy falls.
///
/// The step loop trusts what [`Problem::finish`] says of the energy E. It refuses steps in which E rises by more than its rounding, and
/// steps after which ΔE + ∫D dt, D the dissipation, is not 0 to [`energy_tolerance`](crate::integrator::AdaptiveOptions::energy_tolerance): D must be −dE/dt along f exactly,
/// that is −∇E·f. Where it is not, steps shrink until what each adds to the balance is within the tolerance. The loop ends with
/// [`IntegrationError::OpenBalance`](crate::integrator::IntegrationError::OpenBalance) if it runs out of steps that way; if it comes to
/// its end, it is the sum over all steps that is far out of balance. A problem without an energy tells a constant one and the dissipation 0:
/// then its steps are controlled by their local errors alone.
///
/// ```
/// use flow_core::integrator::{
///     Adaptive, AdaptiveOptions, Bdf, Counters, DISSIPATED, Finish, INTEGRALS, Problem, Stepper,
/// };
///
/// /// ẏ = −50y, with the energy 25y²; holds 1 + 50γ.
/// struct Decay(f64);
///
/// impl Problem for Decay {
///     fn size(&self) -> usize {
///         1
///     }
///     fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
///         rate[0] = -50.0 * y[0];
///     }
///     fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
///         self.rate(y, rate); // J is the same everywhere
///     }
///     fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
///         self.rate(v, out);
///     }
///     fn factorise(&mut self, gamma: f64) -> bool {
///         self.0 = 1.0 + 50.0 * gamma;
///         true
///     }
///     fn precondition(&mut self, r: &mut [f64]) {
///         r[0] /= self.0;
///     }
///     fn finish(&mut self, _: f64, y: &mut [f64]) -> Finish {
///         let mut integral_rates = [0.0; INTEGRALS];
///         integral_rates[DISSIPATED] = 2500.0 * y[0] * y[0]; // −E′(y)f(y)
///         Finish::Good { energy: 25.0 * y[0] * y[0], integral_rates }
///     }
/// }
///
/// let (mut problem, mut y, tolerance) = (Decay(1.0), [1.0], 1e-6);
/// let Finish::Good { energy, integral_rates } = problem.finish(0.0, &mut y) else { panic!("not finite") };
/// let mut counters = Counters::default();
/// let stepper = Bdf::new(&mut problem, &y, integral_rates, tolerance, &mut counters);
/// let energy_tolerance = 0.01 * tolerance;
/// let options = AdaptiveOptions { end: 0.1, most_steps: 1000, energy_tolerance, doubts_gradients: false };
/// let mut steps = Adaptive::new(stepper, options, energy, counters);
/// while steps.stepper().time() < options.end {
///     steps.step(&mut problem)?;
/// }
/// assert!((steps.stepper().state()[0] * f64::exp(5.0) - 1.0).abs() < 1e-4);
/// # Ok::<(), flow_core::integrator::IntegrationError>(())
/// ```
pub trait Problem {
    /// Length of the state.
    fn size(&self) -> usize;
    /// Consecutive blocks of the state; errors are relative to the norm of each block. One of all, if not said otherwise.
    fn blocks(&self) -> Vec<Range<usize>> {
        std::iter::once(0..self.size()).collect()
    }
    /// Least square norm |`y_b|²` that a block's error is compared with.
    fn block_floor(&self, _block: usize, _y: &[f64]) -> f64 {
        f64::MIN_POSITIVE
    }
    /// f(y) into `rate`.
    fn rate(&mut self, y: &[f64], rate: &mut [f64]);
    /// Freezes J at `y`; f(y) into `rate`.
    fn linearise(&mut self, y: &[f64], rate: &mut [f64]);
    /// J times `v` into `out`.
    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]);
    /// Prepares an approximate inverse of I − γJ; false if that fails.
    fn factorise(&mut self, gamma: f64) -> bool;
    /// Overwrites `r` by the approximate solution of (I − γJ)x = r.
    fn precondition(&mut self, r: &mut [f64]);
    /// Weighs a residual of (I − γJ)x = r by how much its coefficients matter; all alike, if not said otherwise.
    fn weigh(&self, _r: &mut [f64]) {}
    /// Undoes [`Problem::weigh`].
    fn unweigh(&self, _r: &mut [f64]) {}
    /// Overwrites the residual `r` of a stage y = a + γf(y) by a change of y that makes good the stiff part of what J, which is
    /// that of a guess, has missed; false if there is none.
    fn settle(&mut self, _gamma: f64, _r: &mut [f64]) -> bool {
        false
    }
    /// Tells how many Krylov iterations a solve took; true if the preconditioner changed its kind and
    /// must be prepared anew.
    fn krylov_feedback(&mut self, _iterations: usize) -> bool {
        false
    }
    /// Puts the candidate `y` back onto the constraints; evaluates what a finished step must know.
    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish;
    /// Whether the energy tells that the flow is at rest: true if f vanishes wherever the energy no longer falls, as in a gradient
    /// flow. A step that fails once the energy has stayed the same to rounding while the time doubled, or that fails for the rounding
    /// of an energy that hardly falls, is then taken with the state held as it is. Where f may move the state along at the same
    /// energy (an oscillator, a constant energy), that would be wrong by as much as f moves it: such a step is tried again, and
    /// fails with an error if it must.
    fn rests_with_its_energy(&self) -> bool {
        false
    }
    /// Whether errors of the state fade with the flow; what is only carried along keeps them.
    fn forgets(&self) -> bool {
        true
    }
    /// The highest frequency of J at the linearisation that nothing damps, as that of waves that are only carried along: the formulas of
    /// higher order multiply these unless steps are short for them.
    fn undamped_frequency(&self) -> f64 {
        0.0
    }
    /// Energy that the rounding of the state finished last may add or take away, where the energy itself is near zero.
    fn energy_rounding(&self, _y: &[f64]) -> f64 {
        0.0
    }
    /// Derivative of the energy along `direction` at the candidate finished last; none where it is not at hand.
    fn energy_slope(&self, _direction: &[f64]) -> Option<f64> {
        None
    }
    /// Whether the dissipation is −dE/dt along f, by another way than the balance of steps near `y`; none where there is no other way.
    /// Asked before [`IntegrationError::OpenBalance`](crate::integrator::IntegrationError::OpenBalance) blames it, for a flow that is
    /// ill-posed has no balance either. Whatever was evaluated or linearised last is lost.
    fn is_gradient_exact(&mut self, _y: &[f64]) -> Option<bool> {
        None
    }
    /// f(y) at the candidate `y` finished last, into `rate`.
    fn finished_rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.rate(y, rate);
    }
    /// A part of J at `y` whose exponential is at hand, into `part`; takes the linearisation to `y`. False if there is none.
    fn linear_part(&mut self, _y: &[f64], _part: &mut LinearPart) -> bool {
        false
    }
    /// Tells that the state finished last was accepted, with the integrals at it.
    fn accepted(&mut self, _time: f64, _integrals: [f64; INTEGRALS]) {}
}

/// What a problem says of a candidate state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// The state is usable.
    Good {
        /// Energy, which may not rise along f; a constant where there is none.
        energy: f64,
        /// Rates of the integrals carried along. The one at [`DISSIPATED`] is the dissipation −dE/dt = −∇E·f ≥ 0, exactly.
        integral_rates: [f64; INTEGRALS],
    },
    /// A value is NaN or infinite, or a constraint cannot be met.
    NotFinite,
}

impl Finish {
    /// The dissipation; infinite where there is none.
    pub(super) fn dissipation(&self) -> f64 {
        match self {
            Self::Good { integral_rates, .. } => integral_rates[DISSIPATED],
            Self::NotFinite => f64::INFINITY,
        }
    }
}
