//! Where the time of the steps goes, without costing any: the clock runs in few of them, the calls are counted in all.
//!
//! A call takes microseconds, a look at the clock a few hundredths of one, and there are two of them for each call. The time of
//! all calls is that of the clocked ones times the ratio of their numbers; nothing of it acts on the steps.

use std::ops::Range;
use std::time::Instant;

use super::{Finish, INTEGRALS, Problem};

/// What a step spends time on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// Rates at the iterates of Newton's method.
    RightHandSide,
    /// Second derivatives of the energy, and the rate, at the predictor.
    Linearisation,
    /// Products of the implicit operator with a vector.
    JacobianProduct,
    /// Factorisations of the preconditioner.
    Factorisation,
    /// Solves with it.
    Solve,
    /// The rest of the linear solves: weights, orthogonalisation, combination.
    Krylov,
    /// Candidates put back onto the constraints, with their energy and dissipation.
    Check,
    /// The rest of the step: predictor, error, size and order.
    StepControl,
}

impl Activity {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::RightHandSide,
        Self::Linearisation,
        Self::JacobianProduct,
        Self::Factorisation,
        Self::Solve,
        Self::Krylov,
        Self::Check,
        Self::StepControl,
    ];
}

/// One step out of so many is clocked: a prime, so that no rhythm of the steps (a factorisation is renewed every 30) hides
/// anything from it.
const STRIDE: u64 = 17;
/// The first steps are clocked all, for the sake of short runs.
const FIRST: u64 = 4;

/// Calls of one activity, those that were clocked, and their time.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    calls: u64,
    clocked: u64,
    seconds: f64,
}

/// Counts and clocks.
#[derive(Clone, Debug, Default)]
pub struct Stopwatch {
    tallies: [Tally; Activity::ALL.len()],
    /// What goes on, and since when; none in a step that is not clocked.
    lap: Option<(Activity, Instant)>,
}

impl Stopwatch {
    /// Starts a step.
    pub fn start_step(&mut self) {
        let step = self.tally(Activity::StepControl);
        let clocked = step.calls < FIRST || step.calls.is_multiple_of(STRIDE);
        step.calls += 1;
        step.clocked += u64::from(clocked);
        self.lap = clocked.then(|| (Activity::StepControl, Instant::now()));
    }

    /// Ends a step.
    pub fn end_step(&mut self) {
        self.turn_to(Activity::StepControl);
        self.lap = None;
    }

    /// How often there was `activity`; of the Krylov iterations and of the steps, their number.
    #[must_use]
    pub fn calls(&self, activity: Activity) -> u64 {
        self.tallies[activity as usize].calls
    }

    /// Seconds of all calls: those of the clocked ones times the ratio of their numbers.
    #[must_use]
    pub fn seconds(&self, activity: Activity) -> f64 {
        let Tally { calls, clocked, seconds } = self.tallies[activity as usize];
        if clocked == 0 { 0.0 } else { seconds * calls as f64 / clocked as f64 }
    }

    fn tally(&mut self, activity: Activity) -> &mut Tally {
        &mut self.tallies[activity as usize]
    }

    /// Counts a call and, if the clock runs, the time before it.
    fn call(&mut self, activity: Activity) {
        self.turn_to(activity);
        let clocked = self.lap.is_some();
        let tally = self.tally(activity);
        tally.calls += 1;
        tally.clocked += u64::from(clocked);
    }

    /// Books the time since the last look on what went on, and goes on with `activity`.
    fn turn_to(&mut self, activity: Activity) {
        if let Some((before, since)) = self.lap {
            let now = Instant::now();
            self.tally(before).seconds += (now - since).as_secs_f64();
            self.lap = Some((activity, now));
        }
    }
}

/// A problem under a stopwatch. What the integrator does between two calls is Krylov work while a linear solve goes on, and
/// step control else.
#[derive(Debug)]
pub struct Clocked<'a, P> {
    problem: &'a mut P,
    watch: &'a mut Stopwatch,
}

impl<'a, P: Problem> Clocked<'a, P> {
    /// `problem` under `watch`.
    pub fn new(problem: &'a mut P, watch: &'a mut Stopwatch) -> Self {
        Self { problem, watch }
    }

    fn during<T>(&mut self, activity: Activity, then: Activity, call: impl FnOnce(&mut P) -> T) -> T {
        self.watch.call(activity);
        let result = call(self.problem);
        self.watch.turn_to(then);
        result
    }
}

impl<P: Problem> Problem for Clocked<'_, P> {
    fn size(&self) -> usize {
        self.problem.size()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        self.problem.blocks()
    }

    fn block_floor(&self, block: usize, y: &[f64]) -> f64 {
        self.problem.block_floor(block, y)
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.during(Activity::RightHandSide, Activity::StepControl, |problem| problem.rate(y, rate));
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.during(Activity::Linearisation, Activity::StepControl, |problem| problem.linearise(y, rate));
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.during(Activity::JacobianProduct, Activity::Krylov, |problem| problem.jacobian_product(v, out));
        // Each product is one Krylov iteration.
        let clocked = self.watch.lap.is_some();
        let krylov = self.watch.tally(Activity::Krylov);
        krylov.calls += 1;
        krylov.clocked += u64::from(clocked);
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.during(Activity::Factorisation, Activity::StepControl, |problem| problem.factorise(gamma))
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.during(Activity::Solve, Activity::Krylov, |problem| problem.precondition(r));
    }

    fn weigh(&self, r: &mut [f64]) {
        self.problem.weigh(r);
    }

    fn unweigh(&self, r: &mut [f64]) {
        self.problem.unweigh(r);
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.watch.turn_to(Activity::StepControl);
        self.problem.krylov_feedback(iterations)
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        self.during(Activity::Check, Activity::StepControl, |problem| problem.finish(time, y))
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.problem.accepted(time, integrals);
    }
}
