//! Why a run fails on the way.

use super::adaptation::ResolutionError;
use super::culprit::Culprit;
use super::setup_error::SetupError;
use crate::energies::TermFault;
use crate::integrator::IntegrationError;

/// Why a run ended before its time. Its record, and a file, hold the message.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum Failure {
    /// The time integration found no further step, or was allowed none.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The same, and a term of the energy is not finite where the next step leads.
    #[error("{error}; a little later, the energy term `{}` is not finite: {culprit}", .culprit.found.term)]
    NotFinite { error: IntegrationError, culprit: Box<Culprit> },
    /// The same, and nodes that move with the curve have come to lie at very different distances.
    #[error(
        "{error}; co-moving nodes lie {ratio:.0} times as far apart in one place as in another: if the curve is sound, \
         take gauge = \"scaled-arc-length\", or a [[flow.switch]] to it before"
    )]
    UnevenNodes { error: IntegrationError, ratio: f64 },
    /// The most nodes do not resolve the state.
    #[error(transparent)]
    Resolution(#[from] ResolutionError),
    /// A term refuses a state met on the way.
    #[error("at t = {time:.6e}: {fault}")]
    Term { time: f64, fault: TermFault },
    /// The next gauge cannot be built on the state at hand.
    #[error("at t = {time:.6e}: {error}")]
    Gauge { time: f64, error: SetupError },
    /// What the scene asks for does not fit into memory on the nodes that the run has come to.
    #[error("at t = {time:.6e}: {error}")]
    Limit { time: f64, error: SetupError },
    /// The state at hand means nothing in the next gauge.
    #[error("at t = {time:.6e}: the state is not finite in the next gauge")]
    NotFiniteInGauge { time: f64 },
}
