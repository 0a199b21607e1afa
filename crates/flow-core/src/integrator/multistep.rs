//! The method of a run: exponential while that pays, implicit from then on.

use super::bdf::Bdf;
use super::error_norm::check_start;
use super::exponential::{self, Exponential};
use super::memory::Memory;
use super::{Counters, INTEGRALS, Integrals, LinearPart, Problem, Rejection, Stepper};

/// The method of a run: [`Exponential`] while the problem has a [`LinearPart`] and what it leaves is not stiff, [`Bdf`] from then on.
/// Both hold past states, so that the change from one to the other costs nothing.
#[derive(Clone, Debug)]
pub struct Multistep {
    method: Method,
    tolerance: f64,
}

#[derive(Clone, Debug)]
enum Method {
    Exponential(Box<Exponential>),
    Implicit(Box<Bdf>),
}

impl Multistep {
    /// Starts at `y` and the time of `integrals`, which go on from their values, with local errors below `tolerance` in the
    /// relative norm; with the exponential method if `problem` has a linear part.
    ///
    /// # Panics
    /// If `y` has not the size of the problem, or `tolerance` is not positive and finite.
    pub fn starting(
        problem: &mut dyn Problem,
        y: &[f64],
        integrals: Integrals,
        tolerance: f64,
        counters: &mut Counters,
    ) -> Self {
        check_start(problem, y, tolerance);
        let mut part = LinearPart::default();
        if !problem.linear_part(y, &mut part) {
            let bdf = Bdf::starting(problem, y, integrals, tolerance, counters);
            return Self { method: Method::Implicit(Box::new(bdf)), tolerance };
        }
        counters.right_hand_sides += 1; // the linearisation takes as much
        counters.factorisations += 1;
        let memory = exponential::start(problem, (y, part), integrals, tolerance, counters);
        Self::resume(problem, memory, tolerance)
    }

    /// Goes on from `memory`, to the same local errors as before if `tolerance` is the same.
    ///
    /// The factorisation that the memory speaks of must be in `problem`.
    #[must_use]
    pub fn resume(problem: &dyn Problem, mut memory: Memory, tolerance: f64) -> Self {
        let method = match memory.exponential.take() {
            Some(own) => Method::Exponential(Box::new(Exponential::resume(problem, memory, own, tolerance))),
            None => Method::Implicit(Box::new(Bdf::resume(problem, memory, tolerance))),
        };
        Self { method, tolerance }
    }

    /// What it takes to go on from here.
    #[must_use]
    pub fn memory(&self) -> Memory {
        match &self.method {
            Method::Exponential(method) => method.memory(),
            Method::Implicit(method) => method.memory(),
        }
    }

    /// Whether the steps are those of the exponential method.
    #[must_use]
    pub fn is_exponential(&self) -> bool {
        matches!(self.method, Method::Exponential(_))
    }

    fn stepper(&self) -> &dyn Stepper {
        match &self.method {
            Method::Exponential(method) => &**method,
            Method::Implicit(method) => &**method,
        }
    }

    fn stepper_mut(&mut self) -> &mut dyn Stepper {
        match &mut self.method {
            Method::Exponential(method) => &mut **method,
            Method::Implicit(method) => &mut **method,
        }
    }
}

impl Stepper for Multistep {
    fn time(&self) -> f64 {
        self.stepper().time()
    }

    fn state(&self) -> &[f64] {
        self.stepper().state()
    }

    fn integrals(&self) -> [f64; INTEGRALS] {
        self.stepper().integrals()
    }

    fn step_size(&self) -> f64 {
        self.stepper().step_size()
    }

    fn limit_step_size(&mut self, largest: f64) {
        self.stepper_mut().limit_step_size(largest);
    }

    fn order(&self) -> usize {
        self.stepper().order()
    }

    fn attempt(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> Result<(), Rejection> {
        if let Method::Exponential(method) = &self.method
            && method.is_exhausted()
        {
            let memory = method.memory().implicit();
            self.method = Method::Implicit(Box::new(Bdf::resume(problem, memory, self.tolerance)));
        }
        self.stepper_mut().attempt(problem, counters)
    }

    fn settle(&mut self, problem: &mut dyn Problem) -> bool {
        self.stepper_mut().settle(problem)
    }

    fn unsettle(&mut self) {
        self.stepper_mut().unsettle();
    }

    fn polish(&mut self, problem: &mut dyn Problem, counters: &mut Counters) -> bool {
        self.stepper_mut().polish(problem, counters)
    }

    fn leave_less(&mut self) {
        self.stepper_mut().leave_less();
    }

    fn dissipation(&mut self, problem: &mut dyn Problem, dissipation: f64) -> f64 {
        self.stepper_mut().dissipation(problem, dissipation)
    }

    fn confirm(&mut self, problem: &mut dyn Problem) -> Result<(), Rejection> {
        self.stepper_mut().confirm(problem)
    }

    fn candidate(&mut self) -> &mut [f64] {
        self.stepper_mut().candidate()
    }

    fn integrals_ahead(&self, rates: [f64; INTEGRALS]) -> Integrals {
        self.stepper().integrals_ahead(rates)
    }

    fn hold(&mut self, size: f64) {
        self.stepper_mut().hold(size);
    }

    fn refuse(&mut self, cause: Rejection, factor: f64) {
        self.stepper_mut().refuse(cause, factor);
    }

    fn accept(&mut self, integrals: Integrals, most_growth: f64) {
        self.stepper_mut().accept(integrals, most_growth);
    }

    fn interpolate(&self, time: f64, y: &mut [f64]) -> [f64; INTEGRALS] {
        self.stepper().interpolate(time, y)
    }
}
