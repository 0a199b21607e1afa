//! Linear maps on nodal fields.

mod band_factors;
mod cyclic_banded;
mod derivative;
mod graded_helmholtz;
mod graded_laplacian;
mod half_stencil;
mod helmholtz;
mod small_lu;

pub use band_factors::{LANES, Lane};
pub use cyclic_banded::{CyclicBanded, FactorisationError};
pub use derivative::{Derivative, DerivativeFamily};
pub use graded_helmholtz::{CurveHelmholtz, GradedHelmholtz};
pub use graded_laplacian::GradedLaplacian;
pub use helmholtz::{Helmholtz, HelmholtzError};
