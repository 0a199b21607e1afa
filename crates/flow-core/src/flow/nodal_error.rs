//! What is wrong with a curve that is given by arrays of nodal values.

use crate::geometry::{Grading, GradingError};
use crate::operators::{FactorisationError, HelmholtzError};

/// The arrays are not those of a curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum NodalError {
    /// Arrays of different lengths.
    #[error("`{field}` has {found} values, and `curvature` has {nodes}: all fields have one value per node")]
    Length { field: &'static str, found: usize, nodes: usize },
    /// Too few nodes.
    #[error("`curvature` has {nodes} values; it takes {fewest} nodes at least")]
    TooFewNodes { nodes: usize, fewest: usize },
    /// A value is NaN or infinite.
    #[error("`{field}` is {value} at node {node}: it must be finite")]
    NotFinite { field: &'static str, node: usize, value: f64 },
    /// The metric is no metric.
    #[error(
        "`metric` is {value:?} at s = {parameter:.6}: it must be positive, and not vanish beside its largest value"
    )]
    NotPositive { parameter: f64, value: f64 },
    /// Sharper than the distance of the nodes.
    #[error(
        "`metric` is not resolved by its {nodes} nodes: interpolated from them to s = {parameter:.6} it is off by {error:.1e} of \
         its value, and at most {bound:.0e} is allowed; give more nodes, or a smoother metric"
    )]
    NotResolved { nodes: usize, parameter: f64, error: f64, bound: f64 },
    /// The nodes are not where the gauge has them.
    #[error(
        "`metric` varies by {spread:.1e} of its mean, and the gauge \"scaled-arc-length\" keeps it uniform: use gauge = \
         \"graded\", which keeps the nodes at their fractions of the arc length, or \"co-moving\""
    )]
    NotUniform { spread: f64 },
    /// H has no inverse.
    #[error(
        "`curvature` has |Γ|∫κ² dσ = {value:.3e}, which is 4π² or more on every closed curve, and finite: no closed curve has it"
    )]
    NoCurvature { value: f64 },
    /// The mean of the metric is no length.
    #[error(
        "`metric` has the mean {length:?}, the length of the curve: it must be positive and finite; choose another unit of length"
    )]
    NoLength { length: f64 },
    /// A result is NaN or infinite, though the arrays are not.
    #[error(
        "{result} is {value} at node {node}: it overflows; choose a unit of length and time in which the arrays are near 1"
    )]
    Overflow { result: &'static str, node: usize, value: f64 },
    /// A pivot of H vanished.
    #[error("`curvature` makes −Δ_s + κ² singular: {0}")]
    Singular(FactorisationError),
}

impl From<GradingError> for NodalError {
    fn from(error: GradingError) -> Self {
        match error {
            GradingError::NotPositive { parameter, value } => Self::NotPositive { parameter, value },
            GradingError::NotResolved { nodes, parameter, error, bound } => {
                Self::NotResolved { nodes, parameter, error, bound }
            }
            GradingError::Samples { samples } => {
                let nodes = samples / Grading::samples(1);
                Self::TooFewNodes { nodes, fewest: Grading::FEWEST_NODES }
            }
        }
    }
}

impl From<HelmholtzError> for NodalError {
    fn from(error: HelmholtzError) -> Self {
        match error {
            HelmholtzError::NoCurvature { value } | HelmholtzError::NotFinite { value } => {
                Self::NoCurvature { value }
            }
            HelmholtzError::NoLength { length } => Self::NoLength { length },
            HelmholtzError::Singular(error) => Self::Singular(error),
        }
    }
}
