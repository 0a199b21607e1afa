//! Data that a term cannot be used with.

/// Why a term refuses a state.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum TermFault {
    /// The nodal lines of the agents meet or change places.
    #[error(
        "`energy.agents`: low_density must stay below high_density on the range of curvatures met, but at node \
         {node}, κ = {curvature:.6}, low_density = {low:.6} and high_density = {high:.6}; change the expressions so \
         that they stay apart there"
    )]
    NodalLinesMeet { node: usize, curvature: f64, low: f64, high: f64 },
    /// A quantity has left the range on which the term means anything.
    #[error(
        "`{term}`: {quantity} = {value:.6e} at node {node} must lie between {least:.6e} and {most:.6e}; start from another \
         state, or change the term so that it keeps the state within"
    )]
    OutOfRange { term: &'static str, quantity: &'static str, node: usize, value: f64, least: f64, most: f64 },
}
