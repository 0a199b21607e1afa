//! Linear maps on nodal fields.

mod band_factors;
mod cyclic_banded;
mod derivative;
mod factorisation_error;
mod graded_helmholtz;
mod graded_laplacian;
mod half_stencil;
mod helmholtz;
mod small_lu;

pub use band_factors::{LANES, Lane};
pub use cyclic_banded::CyclicBanded;
pub use derivative::{Derivative, DerivativeFamily};
pub use factorisation_error::FactorisationError;
pub use graded_helmholtz::CurveHelmholtz;
pub use graded_laplacian::GradedLaplacian;
pub use helmholtz::{Helmholtz, HelmholtzError};
