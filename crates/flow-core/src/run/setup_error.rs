//! Why a scene that reads well makes no initial state.

use super::culprit::Culprit;
use super::scene::SceneError;
use crate::expression::ExpressionError;
use crate::geometry::shapes::ShapeError;
use crate::geometry::{Brief, GradingError};

/// The curve, the densities or the energy of a scene cannot be used together.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum SetupError {
    /// Values of the scene were changed after it was read, to what makes no scene.
    #[error(transparent)]
    Scene(Box<SceneError>),
    /// The curve is not usable.
    #[error("`curve`: {0}")]
    Curve(ShapeError),
    /// The curve turns another number of times.
    #[error(
        "`curve.turning_number` = {expected}, but the tangent of the curve turns {found} times; set \
         turning_number = {found} if this is meant, or check the formulas"
    )]
    TurningNumber { found: i32, expected: i32 },
    /// The nodes do not resolve the curve.
    #[error(
        "`accuracy.nodes` = {nodes} is too few for this curve: sampled there, its ends are {} apart, and at most {} \
         (1 % of its length) is closed silently; try nodes = {} or \"auto\"", Brief(*.gap), Brief(*.bound), 2 * .nodes
    )]
    TooFewNodes { nodes: usize, gap: f64, bound: f64 },
    /// The automatic choice found no number of nodes.
    #[error(
        "`accuracy.nodes` = \"auto\": the scene needs about {needed:.0} nodes, and at most {most} are allowed; {remedy}, \
         or set a number of nodes"
    )]
    TooManyNodes { needed: f64, most: usize, remedy: &'static str },
    /// A density is NaN or infinite.
    #[error(
        "`density.{density}.initial` is {value} at node {node} (s = {parameter:.6}): it must be finite for all s \
         in [0, 1); check the expression for divisions by zero, logarithms and roots"
    )]
    DensityNotFinite { density: String, node: usize, parameter: f64, value: f64 },
    /// The weight of a diffusion is not a positive number.
    #[error(
        "`density.{density}.weight` is {value} at s = {parameter:.6}: it must be positive and finite for all s in \
         [0, 1); add a constant, for example 0.1"
    )]
    WeightNotPositive { density: String, parameter: f64, value: f64 },
    /// The grading is no metric on the nodes.
    #[error("`flow.grading`: {0}")]
    Grading(GradingError),
    /// The nodes of another gauge do not resolve the curve.
    #[error("`flow.switch`: {0}")]
    Switch(#[from] crate::geometry::ClosureError),
    /// A field that the frames shall hold needs more nodes.
    #[error(
        "`output.fields`: \"{field}\" inverts H = −Δ_s + κ², which takes {fewest} nodes at least, and `accuracy.nodes` \
         is {nodes}; try nodes = 128, or drop the field"
    )]
    TooFewNodesForField { field: &'static str, nodes: usize, fewest: usize },
    /// The frames would not fit into memory.
    #[error(
        "`output`: {frames} frames of {nodes} nodes take {} GB, and {} GB are allowed, since a run keeps them in memory; \
         ask for fewer frames, nodes or fields", Brief(*.bytes / 1e9), Brief(*.limit / 1e9)
    )]
    TooMuchOutput { frames: usize, nodes: usize, bytes: f64, limit: f64 },
    /// The matrix would not fit into memory.
    #[error(
        "`accuracy.linear_solver` = \"dense\" factorises a matrix of {unknowns} rows, and at most {most} are allowed; use \
         fewer nodes, or \"auto\""
    )]
    TooLargeForDense { unknowns: usize, most: usize },
    /// A derivative of an expression is too large.
    #[error("`{key}`: {fault}")]
    Expression { key: &'static str, fault: ExpressionError },
    /// The energy, its gradient or its second derivative is NaN or infinite on the initial data.
    #[error(
        "the energy term `{}` is not finite on the initial data: {culprit}; change its expressions so that they and their first \
         two derivatives are finite there, or start from other data", .culprit.found.term
    )]
    EnergyNotFinite { culprit: Box<Culprit> },
    /// No term is to blame, but the state cannot be evaluated.
    #[error(
        "the initial state of {nodes} nodes cannot be evaluated, though each term of the energy is finite on it: the curve does not \
         close on its nodes, its metric is not positive, the mobility is not defined, or powers of such lengths are no numbers; try more \
         `accuracy.nodes`, or a unit in which the curve is neither tiny nor huge"
    )]
    StateNotFinite { nodes: usize },
    /// Two terms have one name, or the name of a term from outside is no key.
    #[error(
        "a term from outside is named `{name}`: names of terms are lower-case letters, digits and `_`, and no two terms of a run \
         have the same one; rename it"
    )]
    TermName { name: &'static str },
    /// A term from outside would lose a part of its energy.
    #[error(transparent)]
    Undeclared(#[from] crate::flow::UndeclaredPart),
    /// A term refuses the initial data.
    #[error(transparent)]
    Term(#[from] crate::energies::TermFault),
}

impl From<SceneError> for SetupError {
    fn from(error: SceneError) -> Self {
        Self::Scene(Box::new(error))
    }
}

impl From<GradingError> for SetupError {
    fn from(error: GradingError) -> Self {
        Self::Grading(error)
    }
}

// Not a `source`: the message holds all of it.
impl From<ShapeError> for SetupError {
    fn from(error: ShapeError) -> Self {
        Self::Curve(error)
    }
}
