//! One-step methods for the same problems and behind the same step loop as the core's BDF, and a linear solver that rivals
//! the core's.

mod auxiliary_fields;
mod controller;
mod esdirk;
mod etdrk4;
mod exponential;
mod one_step;
mod rosenbrock;
mod shared;
mod symbol;
pub mod tableau;

pub use auxiliary_fields::AuxiliaryFields;
pub use controller::Controller;
pub use esdirk::Esdirk;
pub use etdrk4::Etdrk4;
pub use exponential::Weights;
pub use one_step::{Formula, OneStep};
pub use rosenbrock::Rosenbrock;
pub use shared::Shared;
pub use symbol::Symbol;

/// y += factor × x; a zero factor adds nothing, whatever x holds.
fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    if factor != 0.0 {
        for (y, x) in y.iter_mut().zip(x) {
            *y += factor * x;
        }
    }
}
