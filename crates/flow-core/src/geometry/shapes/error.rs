//! What is wrong with a curve, where, and what to change.

use crate::expression::ExpressionError;
use crate::geometry::Brief;

/// Why a shape is not a smooth closed curve that can be resampled.
///
/// `phi` is the parameter of the curve, in [0, 2π); point j of m points stands at `phi` = 2πj/m. An `order`
/// of 0, 1 or 2 is the position and its derivatives by `phi`; an `axis` of 0 or 1 is x or y.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum ShapeError {
    /// A radius, semi-axis or size that is not a length.
    #[error("the size of the curve is {value}: radius, semi-axes and size must be positive and finite")]
    SizeNotPositive { value: f64 },
    /// A formula of the curve has a second variable.
    #[error("the formula `{text}` of the curve depends on more than one variable: write it in phi alone")]
    OtherVariables { text: String },
    /// The formula of the curve cannot be differentiated.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// The position or a derivative is infinite or undefined.
    #[error(
        "{} of the curve is {value} at phi = {phi:.6}: position, first and second derivative must be finite; \
         rewrite the formula without the singularity there",
        ["x", "y", "dx/dphi", "dy/dphi", "d²x/dphi²", "d²y/dphi²"][2 * .order + .axis]
    )]
    NotFinite { order: usize, axis: usize, phi: f64, value: f64 },
    /// The curve is one point.
    #[error("the curve is {} long, must exceed {}: x or y must depend on phi, and r must not be 0", Brief(*.length), Brief(*.bound))]
    ZeroLength { length: f64, bound: f64 },
    /// The position or its derivative differs between phi = 0 and phi = 2π.
    #[error(
        "the curve is open: the {} at phi = 0 and phi = 2π differ by {}, allowed is {}; use only functions of phi with \
         period 2π",
        ["positions", "derivatives by phi"][*.order], Brief(*.gap), Brief(*.bound)
    )]
    NotClosed { order: usize, gap: f64, bound: f64 },
    /// The first derivative vanishes: a cusp, or a parameter that pauses.
    #[error(
        "the curve stops at phi = {phi:.6}: |dγ/dphi| = {}, must exceed {}; remove the cusp, or choose a parameter that \
         does not pause there", Brief(*.speed), Brief(*.bound)
    )]
    Stops { phi: f64, speed: f64, bound: f64 },
    /// The tangent jumps somewhere.
    #[error(
        "the tangent turns {turns:.6} times along the curve, must be a whole number to {bound:.0e}: the curve \
         has a corner; round it off"
    )]
    Corner { turns: f64, bound: f64 },
    /// The curve runs clockwise.
    #[error(
        "the curve is clockwise, its turning number is {turning_number}, must be 0 or more; replace phi by \
         -phi, or reverse the order of the points"
    )]
    Clockwise { turning_number: i32 },
    /// The arc length does not converge.
    #[error(
        "the arc length is not resolved by {cells} cells: near phi = {phi:.6} it still changes by {}, in all \
         allowed is {}; smooth the curve there, or remove a pole of its formula", Brief(*.change), Brief(*.bound)
    )]
    NotResolved { cells: usize, phi: f64, change: f64, bound: f64 },
    /// A list of points too short to be a curve.
    #[error("the curve has {points} points, needs at least {fewest}; sample it more finely")]
    TooFewPoints { points: usize, fewest: usize },
    /// A point that is infinite or undefined.
    #[error("point {point} is ({}, {}): both coordinates must be finite; remove it", .position[0], .position[1])]
    PointNotFinite { point: usize, position: [f64; 2] },
    /// Two neighbours in the list coincide; the last point is a neighbour of the first.
    #[error(
        "points {first} and {second} (from 0) are {} apart, must be more than {}; remove one of them (the curve closes \
         by itself, without repeating its first point)", Brief(*.distance), Brief(*.bound)
    )]
    RepeatedPoints { first: usize, second: usize, distance: f64, bound: f64 },
    /// The points zigzag, so that the curve through them has no meaningful curvature.
    #[error(
        "{points} points are too few for their curve, or noisy: the highest third of their Fourier modes makes \
         {share:.1e} of d²γ/dphi², allowed is {bound:.0e}; smooth them, thin out many that are rounded, or sample more finely"
    )]
    RoughPoints { points: usize, share: f64, bound: f64 },
    /// The distances of neighbours jump, so that the curve through the points, whose parameter is the index, oscillates.
    #[error(
        "{points} points are unevenly spaced: at point {point} (from 0) the distances to its neighbours are {} and {}, and the \
         highest third of the Fourier modes makes {share:.1e} of d²γ/dphi², allowed is {bound:.0e}; space the points smoothly, \
         so that distances change little from one to the next, or sample more finely",
        Brief(*.before), Brief(*.after)
    )]
    UnevenPoints { points: usize, point: usize, before: f64, after: f64, share: f64, bound: f64 },
}
