//! Runs to a time that the caller names.

use std::time::Instant;

use super::Simulation;
use crate::run::observer::Observer;
use crate::run::record::StopReason;

/// Times that lie less than this ahead count as reached: no step is so short.
const NEAREST: f64 = 1e-306;
/// … and beyond this many times the rounding of a time that is asked for: shorter ones change nothing but by rounding.
const NEAREST_ROUNDINGS: f64 = 16.0;

impl Simulation {
    /// At most `steps` steps until `time`, where the last of them ends, or until the run stops. Returns whether there is
    /// more to do. A time that [`Simulation::has_reached`] takes no step.
    ///
    /// # Panics
    /// If `time` is NaN.
    pub fn run_until(&mut self, time: f64, steps: u64, observer: &mut dyn Observer) -> bool {
        assert!(!time.is_nan(), "a run until NaN: that is no time");
        self.until = time;
        self.integration.set_end(self.next_stop());
        let last = self.counters().steps.saturating_add(steps);
        let mut clock = Instant::now();
        while !self.has_reached(time) && self.counters().steps < last && self.stopped.is_none() {
            clock = self.step_since(clock, observer);
        }
        self.until = f64::INFINITY;
        self.integration.set_end(self.next_stop());
        self.stopped.is_none()
    }

    /// Whether the run is at `time`, or less than 1e-306 or sixteen times its rounding before it.
    #[must_use]
    pub fn has_reached(&self, time: f64) -> bool {
        time - self.time() < NEAREST.max(NEAREST_ROUNDINGS * f64::EPSILON * time.abs())
    }

    /// Where the steps must end next: at the end, at a switch, or where the caller wants it.
    pub(super) fn next_stop(&self) -> f64 {
        self.end.min(self.gauges.next_time()).min(self.until)
    }

    /// Takes an interruption back, so that the run can go on.
    pub fn go_on(&mut self) {
        if self.stopped == Some(StopReason::Interrupted) {
            self.stopped = None;
            self.record.frames.truncate(self.scheduled_frames);
        }
    }
}
