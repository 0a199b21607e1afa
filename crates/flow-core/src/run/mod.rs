//! From a scene to a finished run.

mod observer;
mod record;
mod scene;

pub use observer::{Observer, Progress, Quiet};
pub use record::{Counters, Frame, Record, Rejections, StepLog, StopReason};
pub use scene::{
    Accuracy, Agents, Bending, Bound, Curve, Density, DensityMobility, Derivative, Energy, Fault, Flow,
    Formula, Frames, Gauge, Integrator, Length, LengthTarget, LinearSolver, Local, MAX_SCENE_BYTES, Nodes,
    NormalMobility, Output, Place, PointsError, Problem, Regularization, Scene, SceneError, Shape, Spacing,
    Time,
};
