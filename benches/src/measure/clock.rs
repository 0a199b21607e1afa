//! Processor time of this thread: on a machine shared with others the wall clock measures them as well.

use std::time::Instant;

/// A clock that runs while this thread does.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    wall: Instant,
    processor: f64,
}

impl Clock {
    /// Starts.
    #[must_use]
    pub fn start() -> Self {
        Self { wall: Instant::now(), processor: processor_seconds() }
    }

    /// Seconds of processor time since the start; of wall time where the system does not tell.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        processor_seconds() - self.processor
    }

    /// Seconds of wall time since the start.
    #[must_use]
    pub fn wall(&self) -> f64 {
        self.wall.elapsed().as_secs_f64()
    }
}

#[cfg(unix)]
fn processor_seconds() -> f64 {
    use rustix::time::{ClockId, clock_gettime};

    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

#[cfg(not(unix))]
fn processor_seconds() -> f64 {
    use std::time::SystemTime;

    SystemTime::UNIX_EPOCH.elapsed().map_or(f64::NAN, |time| time.as_secs_f64())
}
