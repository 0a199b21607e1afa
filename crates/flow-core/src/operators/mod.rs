//! Linear maps on nodal fields.

mod band_factors;
mod cyclic_banded;
mod derivative;
mod helmholtz;
mod small_lu;

pub use cyclic_banded::{CyclicBanded, FactorisationError};
pub use derivative::{Derivative, DerivativeFamily};
pub use helmholtz::{Helmholtz, HelmholtzError};
