//! What the step loop asks of a method.

use super::integrals::{INTEGRALS, Integrals};
use super::problem::Problem;
use super::statistics::{Counters, Rejection};

/// A one- or multi-step method with its own control of step size and order.
pub trait Stepper {
    /// Time of the last accepted state.
    fn time(&self) -> f64;
    /// The last accepted state.
    fn state(&self) -> &[f64];
    /// The integrals at the last accepted state.
    fn integrals(&self) -> [f64; INTEGRALS];
    /// Size of the next attempt.
    fn step_size(&self) -> f64;
    /// Limits the size of the next attempt.
    fn limit_step_size(&mut self, largest: f64);
    /// Order of the last accepted step.
    fn order(&self) -> usize;
    /// Tries one step of [`Stepper::step_size`].
    ///
    /// # Errors
    /// The cause of the rejection; the step size is then already reduced.
    fn attempt(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> Result<(), Rejection>;
    /// Makes good what the implicit solve has missed in stiff modes of the candidate, which `problem` has finished last, as far as
    /// that takes no linear system; false if it takes one.
    fn settle(&mut self, _problem: &mut dyn Problem) -> bool {
        false
    }
    /// Takes [`Stepper::settle`] back.
    fn unsettle(&mut self) {}
    /// Solves the candidate more exactly; false if that cannot be done.
    fn polish(&mut self, _problem: &mut dyn Problem, _counters: &mut Counters) -> bool {
        false
    }
    /// Leaves less in the linear systems to come: what they left was seen to spoil a candidate.
    fn leave_less(&mut self) {}
    /// What the energy loses at the candidate along the trajectory of the method: its `dissipation`, but for the error of the
    /// implicit solve.
    fn dissipation(&mut self, _problem: &mut dyn Problem, dissipation: f64) -> f64 {
        dissipation
    }
    /// Whether the candidate, which `problem` has finished last, solves the formula of the method, as far as only its rate tells.
    ///
    /// # Errors
    /// The cause of the rejection; the step size is then already reduced.
    fn confirm(&mut self, _problem: &mut dyn Problem) -> Result<(), Rejection> {
        Ok(())
    }
    /// The candidate of the last attempt.
    fn candidate(&mut self) -> &mut [f64];
    /// The integrals at the candidate, with their rates there.
    fn integrals_ahead(&self, rates: [f64; INTEGRALS]) -> Integrals;
    /// Takes a step of size `size` in which the state and the integrals stay.
    fn hold(&mut self, size: f64);
    /// Throws the candidate away for a `cause` found outside and reduces the step size by `factor`.
    fn refuse(&mut self, cause: Rejection, factor: f64);
    /// Accepts the candidate, which has been confirmed, with the integrals at it; by the clock the next step is at most
    /// `most_growth` times as long.
    fn accept(&mut self, integrals: Integrals, most_growth: f64);
    /// State at a time within the last accepted step.
    fn interpolate(&self, time: f64, y: &mut [f64]) -> [f64; INTEGRALS];
}
