//! From a scene to a finished run.

mod diagnostics;
mod energy_density;
mod energy_terms;
mod equilibrium;
mod frames;
mod grading;
mod interpolant;
mod invariants;
mod membrane;
mod mobilities;
mod nodal_lines;
mod observer;
mod prediction;
mod record;
mod resolution;
pub mod scene;
mod schedule;
mod setup;
mod setup_error;
mod simulation;
mod switches;
mod term_parts;
pub mod tradeoff;

pub use crate::integrator::{Counters, Rejections};
pub use energy_terms::nodal_lines;
pub use equilibrium::Equilibrium;
pub use interpolant::Interpolant;
pub use membrane::{ANGLE, CENTRE, DISSIPATED, Membrane};
pub use nodal_lines::nodal_polylines;
pub use observer::{Observer, Progress, Quiet};
pub use prediction::{Prediction, predict};
pub use record::{Frame, Record, StepLog, StopReason};
pub use scene::{Scene, SceneError};
pub use setup::Setup;
pub use setup_error::SetupError;
pub use simulation::{ENERGY_TOLERANCE_SHARE, Memory, ResumeError, Simulation, run};
