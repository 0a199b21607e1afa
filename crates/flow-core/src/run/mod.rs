//! From a scene to a finished run.

mod membrane;
mod observer;
mod record;
pub mod scene;

pub use crate::integrator::{Counters, Rejections};
pub use membrane::{ANGLE, CENTRE, DISSIPATED, Membrane};
pub use observer::{Observer, Progress, Quiet};
pub use record::{Frame, Record, StepLog, StopReason};
pub use scene::{Scene, SceneError};
