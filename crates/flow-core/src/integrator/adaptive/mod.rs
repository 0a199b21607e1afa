//! The step loop with its guards: finite values, falling energy, step sizes above rounding.

mod parts;

use super::balance::{BALANCED, ENERGY_ROUNDING, IMBALANCE, growth_in_balance, share_lost};
use super::{
    Counters, DISSIPATED, EnergyScale, Finish, INTEGRALS, IntegrationError, Problem, Rejection, Rejections,
    Rest, StepReport, Stepper,
};

/// Settings of the loop.
#[derive(Clone, Copy, Debug)]
pub struct AdaptiveOptions {
    /// End of the integration.
    pub end: f64,
    /// Most accepted steps.
    pub most_steps: u64,
    /// Part of the energy, as [`EnergyScale`] measures it, by which one step's balance of energy and dissipation may be off.
    pub energy_tolerance: f64,
    /// Whether a gradient may not be the derivative of its energy: then that is looked into where the steps do not get on.
    pub doubts_gradients: bool,
}

/// The loop around a stepper, for a [`Problem`] whose energy falls by its dissipation.
#[derive(Debug)]
pub struct Adaptive<S> {
    stepper: S,
    options: AdaptiveOptions,
    energy: f64,
    scale: EnergyScale,
    rest: Rest,
    /// Whether the last candidate was at rest, and above the last energy by its rounding alone.
    idle: bool,
    counters: Counters,
}

/// Part of the time so far whose loss, at the rate of the step, is a scale of the energy at least: less than what is left of an energy that
/// falls as the inverse third power of the time, as a stiff cost does.
const PASSING: f64 = 0.3;
/// Changes by more than this part of the energy are not its rounding.
const PLAIN: f64 = 1e-4;
/// A dissipation that would lose this many times the energy that the step lost is an error of the solve.
const ROUGH: f64 = 2.0;
/// Part of the energy tolerance below which such an error does not matter.
const UNSEEN: f64 = 0.1;
/// Smallest factor of the next attempt at a step that was thrown away.
const LEAST_FACTOR: f64 = 0.5;
const MOST_POLISHES: usize = 2;
/// Corrections that leave more than this part of the dissipation are not worth another one.
const UNMENDED: f64 = 0.5;
/// The step size must stay above this many units in the last place of the time.
const LEAST_STEP_ULPS: f64 = 16.0;
/// Differences of times below this have no reciprocals.
const LEAST_STEP: f64 = LEAST_STEP_ULPS * f64::MIN_POSITIVE;

impl<S: Stepper> Adaptive<S> {
    /// A loop from the state of `stepper`, whose energy is `energy`.
    ///
    /// # Panics
    /// If the end is NaN, or the energy tolerance NaN or negative.
    #[must_use]
    pub fn new(stepper: S, options: AdaptiveOptions, energy: f64, counters: Counters) -> Self {
        assert!(!options.end.is_nan(), "the end of an integration is NaN");
        let tolerance = options.energy_tolerance;
        assert!(tolerance >= 0.0, "an energy tolerance of {tolerance:?}: it must not be negative");
        let rest = Rest::new(stepper.time(), energy);
        let scale = EnergyScale::new(energy, 0.0);
        Self { stepper, options, energy, scale, rest, idle: false, counters }
    }

    /// The same with errors of the energy relative to `scale`: without it they are to the energy itself.
    #[must_use]
    pub fn measured_by(mut self, scale: EnergyScale) -> Self {
        self.scale = scale;
        self
    }

    /// Goes on with a watch that was kept before.
    pub fn watch_on(&mut self, rest: Rest) {
        self.rest = rest;
    }

    /// Takes one step, trying again until one is accepted.
    ///
    /// # Errors
    /// [`IntegrationError`]; the last accepted state stays.
    pub fn step(&mut self, problem: &mut dyn Problem) -> Result<StepReport, IntegrationError> {
        let (start, before) = (self.stepper.time(), self.energy);
        if self.counters.steps >= self.options.most_steps {
            let steps = self.counters.steps;
            return Err(self.cause(problem, IntegrationError::TooManySteps { time: start, steps }));
        }
        let mut rejections = Rejections::default();
        loop {
            self.stepper.limit_step_size(self.remaining(start));
            let size = self.stepper.step_size();
            if size < LEAST_STEP {
                return Err(IntegrationError::StopTooNear { time: start, step: size, least: LEAST_STEP });
            }
            let mut outcome = self.attempt(problem);
            if let Err(cause) = outcome
                && problem.rests_with_its_energy()
                && (self.rest.reached(start) || self.idle)
            {
                rejections.count(cause);
                self.counters.rejections.count(cause);
                outcome = Ok(self.hold(problem, size));
            }
            match outcome {
                Ok((energy, [dissipation, settled_dissipation])) => {
                    self.counters.steps += 1;
                    return Ok(StepReport {
                        time: self.stepper.time(),
                        size,
                        order: self.stepper.order(),
                        energy,
                        lost: before - energy,
                        dissipation,
                        settled_dissipation,
                        rejections,
                    });
                }
                Err(cause) => {
                    rejections.count(cause);
                    self.counters.rejections.count(cause);
                    let step = self.stepper.step_size();
                    if step < LEAST_STEP.max(LEAST_STEP_ULPS * start.abs() * f64::EPSILON) {
                        let rejections = rejections.total();
                        let error = IntegrationError::StepUnderflow { time: start, step, rejections, cause };
                        return Err(self.cause(problem, error));
                    }
                }
            }
        }
    }

    /// What is behind `error`: a balance that no step closes keeps the steps short, whatever ends them.
    #[cold]
    fn cause(&mut self, problem: &mut dyn Problem, error: IntegrationError) -> IntegrationError {
        if !self.options.doubts_gradients {
            return error;
        }
        let (time, step, state) = (self.stepper.time(), self.stepper.step_size(), self.stepper.state());
        match share_lost(problem, time, state, step) {
            Some(share) if problem.is_gradient_exact(state) != Some(true) => IntegrationError::OpenBalance {
                time,
                steps: self.counters.steps,
                step,
                percent: 100.0 * share,
            },
            _ => error,
        }
    }

    /// Largest useful step: to the end, or half of the way, and a hair more for the sake of rounding, if the rest would be a
    /// sliver.
    fn remaining(&self, start: f64) -> f64 {
        let rest = self.options.end - start;
        let step = self.stepper.step_size();
        if step < rest && 2.0 * step > rest { (0.5 + 1e-12) * rest } else { rest }
    }

    /// The energy and both dissipations of [`StepReport`].
    fn attempt(&mut self, problem: &mut dyn Problem) -> Result<(f64, [f64; 2]), Rejection> {
        self.idle = false;
        self.stepper.attempt(problem, &mut self.counters)?;
        let size = self.stepper.step_size();
        let time = self.stepper.time() + size;
        let mut finish = self.finish(problem, time);
        if self.is_rough(problem, &finish, size) && self.stepper.settle(problem) {
            let rough = finish.dissipation();
            finish = self.finish(problem, time);
            // Late, when steps are long, what is left is no matter of the curvature alone.
            if finish.dissipation() > rough {
                self.stepper.unsettle();
                finish = self.finish(problem, time);
            }
        }
        for _ in 0..MOST_POLISHES {
            if !self.is_rough(problem, &finish, size) || !self.stepper.polish(problem, &mut self.counters) {
                break;
            }
            let before = finish.dissipation();
            finish = self.finish(problem, time);
            if finish.dissipation() > before {
                self.stepper.leave_less();
            }
            if finish.dissipation() > UNMENDED * before {
                break;
            }
        }
        match finish {
            Finish::NotFinite => Err(self.refuse(Rejection::NotFinite, LEAST_FACTOR)),
            Finish::Good { energy, .. } if self.rises(problem, energy) => {
                let rounding = self.rounding(problem, energy);
                let (dissipation, matters) =
                    (finish.dissipation(), self.options.energy_tolerance * self.scale.of(energy));
                if energy <= self.energy + 2.0 * rounding {
                    self.idle = dissipation * time <= rounding;
                    // Too short for the dissipation to be seen, which has been no matter all the time so far.
                    if dissipation * size <= rounding && dissipation * time <= matters {
                        self.rest.reach(self.energy);
                    }
                }
                Err(self.refuse(Rejection::EnergyRise, LEAST_FACTOR))
            }
            Finish::Good { energy, mut integral_rates } => {
                let dissipation = integral_rates[DISSIPATED];
                // A step that loses less than the rounding of the energy has moved the state by rounding.
                integral_rates[DISSIPATED] = if dissipation * size > ENERGY_ROUNDING * energy.abs() {
                    self.stepper.dissipation(problem, dissipation)
                } else {
                    dissipation
                };
                let integrals = self.stepper.integrals_ahead(integral_rates);
                let mut imbalance = self.imbalance(energy, 0.0, integrals.values());
                let mut rounding = 0.0;
                // It takes as long as a transform to know, and mostly does not matter.
                if !(imbalance < BALANCED && (energy - self.energy).abs() > PLAIN * energy.abs()) {
                    rounding = self.rounding(problem, energy);
                    // Times, and so the size of the step, and the integral are known to a unit in the last place.
                    let dissipated = integral_rates[DISSIPATED] * time.abs() + integrals.values()[DISSIPATED];
                    let of_balance = rounding + f64::EPSILON * dissipated.abs();
                    imbalance = self.imbalance(energy, of_balance, integrals.values());
                }
                if imbalance.is_nan() || !integral_rates.iter().all(|rate| rate.is_finite()) {
                    return Err(self.refuse(Rejection::NotFinite, LEAST_FACTOR));
                }
                if imbalance > 1.0 {
                    return Err(self.refuse(Rejection::Error, growth_in_balance(imbalance).max(LEAST_FACTOR)));
                }
                self.stepper.confirm(problem)?;
                self.rest.watch(time, energy, rounding);
                self.energy = energy;
                self.stepper.accept(integrals, growth_in_balance(imbalance));
                problem.accepted(time, self.stepper.integrals());
                Ok((energy, [dissipation, integral_rates[DISSIPATED].min(dissipation)]))
            }
        }
    }

    /// Throws the candidate away.
    fn refuse(&mut self, cause: Rejection, factor: f64) -> Rejection {
        self.stepper.refuse(cause, factor);
        cause
    }

    /// A step of size `size` in which the state stays: the flow is at rest, and what moves it is rounding.
    fn hold(&mut self, problem: &mut dyn Problem, size: f64) -> (f64, [f64; 2]) {
        self.stepper.hold(size);
        let time = self.stepper.time();
        self.finish(problem, time); // the candidate is that state
        problem.accepted(time, self.stepper.integrals());
        (self.energy, [0.0; 2])
    }

    /// By how much rounding may change the energy from the last one to `energy`, that of the candidate.
    fn rounding(&mut self, problem: &mut dyn Problem, energy: f64) -> f64 {
        let sensitivity = problem.energy_rounding(self.stepper.candidate());
        ENERGY_ROUNDING * self.energy.abs().max(energy.abs()) + sensitivity
    }

    /// Whether `energy`, that of the candidate, is above the last one by more than rounding, which is looked at only where it is
    /// above at all.
    fn rises(&mut self, problem: &mut dyn Problem, energy: f64) -> bool {
        energy > self.energy && energy > self.energy + self.rounding(problem, energy)
    }

    /// How far the energy lost in the step to the candidate and the integral of the dissipation are apart: far, if the
    /// step is too large for a transient that the norm of the state does not see. In units of what is allowed.
    fn imbalance(&self, energy: f64, rounding: f64, integrals: [f64; INTEGRALS]) -> f64 {
        let dissipated = integrals[DISSIPATED] - self.stepper.integrals()[DISSIPATED];
        let scale = self.scale.of(self.energy).max(self.scale.of(energy));
        // What is left of the energy may pass through zero, but not what is lost at this rate in a time like that so far.
        let times = 1.0 + self.stepper.time() / self.stepper.step_size();
        let scale = scale.max(PASSING * times * (self.energy - energy));
        let allowed = IMBALANCE * self.options.energy_tolerance * scale + rounding;
        (energy - self.energy + dissipated).abs() / allowed.max(f64::MIN_POSITIVE)
    }

    fn finish(&mut self, problem: &mut dyn Problem, time: f64) -> Finish {
        self.counters.right_hand_sides += 1;
        problem.finish(time, self.stepper.candidate())
    }

    /// Whether the dissipation does not fit the energy lost in the step: the implicit solve has left errors in
    /// stiff modes that the norm of the state does not see.
    fn is_rough(&mut self, problem: &mut dyn Problem, finish: &Finish, size: f64) -> bool {
        let Finish::Good { energy, .. } = finish else { return false };
        let lost = (self.energy - energy).abs();
        // What is lost is known to rounding, which a constant of the motion makes larger than what matters.
        let unseen = UNSEEN * self.options.energy_tolerance * self.scale.of(*energy);
        let unseen = unseen.max(ENERGY_ROUNDING * energy.abs());
        self.rises(problem, *energy) || finish.dissipation() * size > ROUGH * lost + unseen
    }
}
