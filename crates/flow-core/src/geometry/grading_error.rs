//! Why a grading cannot be used.

/// The grading cannot be used on a grid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum GradingError {
    /// An odd number of samples, or too few.
    #[error(
        "the grading has {samples} samples: it takes an even number of them, two for each of at least two nodes"
    )]
    Samples { samples: usize },
    /// Not a metric.
    #[error(
        "the grading is {value:?} at s = {parameter:.6}: it must be positive and finite for all s in [0, 1), and not \
         vanish beside its largest value; add a constant to it"
    )]
    NotPositive { parameter: f64, value: f64 },
    /// Sharper than the distance of the nodes.
    #[error(
        "the grading is not resolved by {nodes} nodes: interpolated from them to s = {parameter:.6} it is off by \
         {error:.1e} of its value, and at most {bound:.0e} is allowed; use more nodes, or a smoother grading"
    )]
    NotResolved { nodes: usize, parameter: f64, error: f64, bound: f64 },
}
