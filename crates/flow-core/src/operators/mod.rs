//! Linear maps on nodal fields.

mod cyclic_banded;
mod derivative;

pub use cyclic_banded::{CyclicBanded, FactorisationError};
pub use derivative::{Derivative, DerivativeFamily};
