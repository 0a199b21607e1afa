//! Where the time of the steps goes, at next to no cost: the clock runs in few of them, the calls are counted in all.
//!
//! A call takes microseconds, a look at the clock a few hundredths of one, and there are two of them for each call. The time of
//! all calls is that of the clocked ones times the ratio of their numbers; nothing of it acts on the steps.

mod clocked;

use std::time::Instant;

pub use clocked::Clocked;

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
