//! Why a matrix could not be factorised.

/// The matrix has no usable LU factorisation.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the banded matrix is singular to working precision: pivot {pivot:.3e} in row {row}")]
pub struct FactorisationError {
    /// Row of the pivot.
    pub row: usize,
    /// Its value.
    pub pivot: f64,
}
