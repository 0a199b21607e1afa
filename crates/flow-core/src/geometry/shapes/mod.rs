//! Initial curves: from a formula or a list of points to curvature at nodes of equal arc length.
//!
//! A [`Shape`] is a curve γ(φ), φ ∈ [0, 2π), counter-clockwise where it encloses an area. Its derivatives
//! are exact; its arc length σ(φ) is integrated by Gauss–Legendre rules on cells of φ, which are halved until
//! every cell agrees with its halves. [`Shape::resample`] inverts σ(φᵢ) = i|Γ|/n to rounding, starting with
//! φ₀ = 0, and takes the curvature (x′y″ − y′x″)/|γ′|³ there.
//!
//! ```
//! use flow_core::expression::Expression;
//! use flow_core::geometry::shapes::Shape;
//!
//! let shape = Shape::Polar { r: Expression::parse("1 + 0.35*cos(3*phi)", &["phi"])? };
//! let curve = shape.resample(256)?;
//! assert_eq!((curve.curvature.len(), curve.turning_number), (256, 1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arc_length;
mod curve;
mod error;
mod jet;
mod points;
mod quadrature;
mod resample;
mod shape;

pub use error::ShapeError;
pub use resample::{ByArcLength, Resampled};
pub use shape::Shape;
