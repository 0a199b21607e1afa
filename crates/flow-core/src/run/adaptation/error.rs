//! Why a run ends that chooses its nodes itself: the most of them leave much of the state unresolved.

/// What the most nodes do not resolve, long after they were taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum ResolutionError {
    /// The curvature.
    #[error(
        "at t = {time:.6e} even {nodes} nodes, the most, leave {part:.1e} of the curvature unresolved: finer nodes only show \
         finer waves, as where compression or pressure meets no bending, or a density that bends the curve separates and its slopes cost nothing, or \
         a finer cusp, as where a loop shrinks under tension; add `energy.bending`, `energy.regularization` or, to `energy.local`, a \
         cost of slopes (0.5*c*rho_sigma^2, rho the name of the density), or set `accuracy.nodes`, on which the result will depend"
    )]
    Curvature { time: f64, nodes: usize, part: f64 },
    /// A density.
    #[error(
        "at t = {time:.6e} even {nodes} nodes, the most, leave {part:.1e} of the density `{density}` unresolved: finer nodes \
         only show finer stripes, as where a density separates and its slopes cost nothing; add such a cost to \
         `energy.local` (0.5*c*{density}_sigma^2), or set `accuracy.nodes`, on which the result will depend"
    )]
    Density { time: f64, nodes: usize, density: String, part: f64 },
    /// The metric.
    #[error(
        "at t = {time:.6e} even {nodes} nodes, the most, leave {part:.1e} of the metric unresolved: the nodes move with the \
         curve, apart here and together there; try `flow.gauge` = \"scaled-arc-length\", or set `accuracy.nodes`, on which \
         the result will depend"
    )]
    Metric { time: f64, nodes: usize, part: f64 },
}
