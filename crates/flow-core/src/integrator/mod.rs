//! Adaptive time integration of dy/dt = f(y), exponential while that pays and implicit from then on; sees a right-hand side, a
//! Jacobian and `&[f64]`.

mod adaptive;
mod balance;
mod bdf;
mod clock;
mod energy_scale;
mod error;
mod error_norm;
mod exponential;
mod gmres;
mod history;
mod integrals;
mod linear_part;
mod memory;
mod multistep;
mod newton;
mod pace;
mod problem;
mod rest;
mod statistics;
mod step_report;
mod stepper;
mod stopwatch;

pub use adaptive::{Adaptive, AdaptiveOptions};
pub(crate) use balance::ENERGY_ROUNDING;
pub use bdf::Bdf;
pub use energy_scale::EnergyScale;
pub use error::IntegrationError;
pub use error_norm::ErrorNorm;
pub use exponential::{Exponential, ExponentialMemory};
pub use gmres::{Gmres, Solved, Target};
pub use history::History;
pub use integrals::{DISSIPATED, INTEGRALS, Integrals};
pub use linear_part::LinearPart;
pub use memory::Memory;
pub use multistep::Multistep;
pub use newton::{Exactness, Factorisation, NewtonKrylov, NewtonOutcome, Stage};
pub use problem::{Finish, Problem};
pub use rest::Rest;
pub use statistics::{Counters, Rejection, Rejections};
pub use step_report::StepReport;
pub use stepper::Stepper;
pub use stopwatch::{Activity, Clocked, Stopwatch};
