//! From a scene to a finished run.

mod observer;
mod record;

pub use observer::{Observer, Progress, Quiet};
pub use record::{Counters, Frame, Record, Rejections, StepLog, StopReason};
