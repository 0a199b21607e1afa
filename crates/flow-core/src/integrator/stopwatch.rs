//! Where the time of the steps goes, at next to no cost: the clock runs in few of them, the calls are counted in all.
//!
//! A call takes microseconds, a look at the clock a few hundredths of one, and there are two of them for each call. The time of
//! all calls is that of the clocked ones times the ratio of their numbers; nothing of it acts on the steps.

use std::ops::Range;
use std::time::Instant;

use super::{Finish, INTEGRALS, LinearPart, Problem};

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
const STRIDE: u64 = 29;
/// The first steps are clocked all, for the sake of short runs.
const FIRST: u64 = 3;

/// A lap of more than a millisecond that is so many times as long as those before it in the mean is not the program's: the
/// machine did something else. It counts as one of the others.
const INTERRUPTED: f64 = 20.0;
const SHORT: f64 = 1e-3;

/// Calls of one activity, those that were clocked, and their time.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    calls: u64,
    clocked: u64,
    laps: u64,
    seconds: f64,
}

impl Tally {
    fn book(&mut self, lap: f64) {
        let mean = self.seconds / self.laps as f64; // NaN before the first: no lap is longer than that
        self.seconds += if lap > SHORT && lap > INTERRUPTED * mean { mean } else { lap };
        self.laps += 1;
    }
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
        let Tally { calls, clocked, seconds, .. } = self.tallies[activity as usize];
        if clocked == 0 { 0.0 } else { seconds * calls as f64 / clocked as f64 }
    }

    fn tally(&mut self, activity: Activity) -> &mut Tally {
        &mut self.tallies[activity as usize]
    }

    /// Whether a call now is to be clocked although its step is not: what is rare would be missed else. The very first call, which
    /// finds cold caches, is not.
    fn lacks(&self, activity: Activity) -> bool {
        let Tally { calls, clocked, .. } = self.tallies[activity as usize];
        self.lap.is_none() && STRIDE * clocked < calls
    }

    /// Counts a call.
    fn count(&mut self, activity: Activity) {
        let clocked = self.lap.is_some();
        let tally = self.tally(activity);
        tally.calls += 1;
        tally.clocked += u64::from(clocked);
    }

    /// Books the time since the last look on what went on, and goes on with `activity`.
    fn turn_to(&mut self, activity: Activity) {
        if let Some((before, since)) = self.lap {
            let now = Instant::now();
            self.tally(before).book((now - since).as_secs_f64());
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
        if self.watch.lacks(activity) {
            self.watch.lap = Some((activity, Instant::now()));
            self.watch.count(activity);
            let result = call(self.problem);
            self.watch.end_step();
            return result;
        }
        self.watch.turn_to(activity);
        self.watch.count(activity);
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
        self.watch.count(Activity::Krylov); // each product is one iteration
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

    fn settle(&mut self, gamma: f64, r: &mut [f64]) -> bool {
        self.problem.settle(gamma, r)
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.watch.turn_to(Activity::StepControl);
        self.problem.krylov_feedback(iterations)
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        self.during(Activity::Check, Activity::StepControl, |problem| problem.finish(time, y))
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        self.problem.energy_slope(direction)
    }

    fn rests_with_its_energy(&self) -> bool {
        self.problem.rests_with_its_energy()
    }

    fn energy_rounding(&self, y: &[f64]) -> f64 {
        self.problem.energy_rounding(y)
    }

    fn is_gradient_exact(&mut self, y: &[f64]) -> Option<bool> {
        self.problem.is_gradient_exact(y)
    }

    fn finished_rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.problem.finished_rate(y, rate);
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        self.during(Activity::Linearisation, Activity::StepControl, |problem| problem.linear_part(y, part))
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.problem.accepted(time, integrals);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interruptions_count_as_one_of_the_other_laps() {
        let mut tally = Tally::default();
        for lap in [2e-3, 4e-3, 1.0, 0.03] {
            tally.book(lap);
        }
        assert!((tally.seconds - 0.039).abs() < 1e-15, "{tally:?}");
        let mut short = Tally::default();
        for lap in [1e-8, 9e-4] {
            short.book(lap);
        }
        assert!((short.seconds - 9.0001e-4).abs() < 1e-15, "{short:?}");
    }

    #[test]
    fn calls_are_counted_in_all_steps_and_clocked_in_some() {
        let mut watch = Stopwatch::default();
        for _ in 0..40 {
            watch.start_step();
            watch.turn_to(Activity::Solve);
            watch.count(Activity::Solve);
            watch.turn_to(Activity::Krylov);
            watch.end_step();
        }
        assert_eq!((watch.calls(Activity::Solve), watch.calls(Activity::StepControl)), (40, 40));
        // Steps 0 to 2, and 29.
        assert_eq!(watch.tally(Activity::Solve).clocked, 4);
        assert!(watch.seconds(Activity::Solve) > 0.0);
        assert_eq!(watch.seconds(Activity::Check), 0.0);
    }

    #[test]
    fn what_is_rare_is_clocked_in_any_step() {
        let mut watch = Stopwatch::default();
        assert!(!watch.lacks(Activity::Factorisation));
        watch.count(Activity::Factorisation);
        assert!(watch.lacks(Activity::Factorisation));
        watch.start_step(); // is clocked anyhow
        assert!(!watch.lacks(Activity::Factorisation));
        watch.count(Activity::Factorisation);
        watch.end_step();
        assert!(!watch.lacks(Activity::Factorisation));
    }
}
