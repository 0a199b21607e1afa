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
    /// More pairs of nodes within the range of a kernel than there is memory for.
    #[error(
        "`energy.adhesion`: {pairs} pairs of {nodes} nodes lie within the range of the kernel or little beyond, and at most {most} \
         are allowed, since second derivatives are kept in memory for each; try {} nodes, which may have any kernel, or a \
         smaller energy.adhesion.cutoff", most_nodes(*.most)
    )]
    TooManyPairs { nodes: usize, pairs: usize, most: usize },
    /// A quantity has left the range on which the term means anything.
    #[error(
        "`{term}`: {quantity} = {value:.6e} at node {node} must lie between {least:.6e} and {most:.6e}; start from another \
         state, or change the term so that it keeps the state within"
    )]
    OutOfRange { term: &'static str, quantity: &'static str, node: usize, value: f64, least: f64, most: f64 },
}

/// The most nodes that have no more than so many pairs.
pub(super) fn most_nodes(pairs: usize) -> usize {
    (8 * pairs + 1).isqrt().div_ceil(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_nodes_have_no_more_pairs() {
        for (pairs, nodes) in [(0, 1), (1, 2), (2, 2), (3, 3), (5, 3), (6, 4), (1 << 27, 16_384)] {
            assert_eq!(most_nodes(pairs), nodes, "{pairs}");
        }
    }
}
