//! What can go wrong with one run of a ladder, and with the whole of it.

use super::super::scene::Nodes;
use super::super::setup_error::SetupError;

/// Why a run of a ladder has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum RunError {
    /// The scene makes no initial state at this tolerance.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The integration failed.
    #[error("stopped at t = {time:.6e}, before t = {end:.6e}: {message}")]
    Failed { time: f64, end: f64, message: String },
    /// An observer asked to stop, in this run or in one before it.
    #[error("interrupted before the run was complete")]
    Interrupted,
}

/// Why a ladder could not be measured at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum TradeoffError {
    /// The scene makes no initial state.
    #[error(transparent)]
    Setup(SetupError),
    /// The run that finds the times of comparison failed.
    #[error("the scene does not run at its own tolerance {tolerance:e}")]
    Scout { tolerance: f64, source: RunError },
    /// The reference failed.
    #[error(
        "the reference at tolerance {tolerance:e} ({nodes}) failed, so there is nothing to measure against; try \
         a ladder that ends at a larger tolerance"
    )]
    Reference { tolerance: f64, nodes: Nodes, source: RunError },
    /// The reference would be coarser than what it measures.
    #[error(
        "the reference has {nodes} nodes, but a run that it measures {least}: it must not have fewer; try {}", 2 * .least
    )]
    FewerNodes { nodes: usize, least: usize },
    /// An observer asked to stop before the reference was complete.
    #[error("interrupted before the reference was complete: nothing is measured yet")]
    Interrupted,
}
