//! Closed planar curves as nodal fields: state, grid, shapes, embedding, closure and measures.
//!
//! Curves run counter-clockwise; the normal points outwards, so a circle of radius R has curvature +1/R.
//! The parameter s ∈ [0, 1) has the nodes sᵢ = i/n. See `THEORY.md`, section 1.

mod brief;
mod cells;
mod closure;
mod crossings;
mod curve_geometry;
mod embedding;
mod gradation;
mod grading;
mod grading_error;
mod grid;
mod inverse_arc_length;
mod kept;
mod measures;
mod metric_grading;
mod midpoints;
mod real_transform;
mod resampling;
mod scattered_points;
pub mod shapes;
mod spectral;
mod state;
mod unit_vectors;
pub mod vectors;

pub(crate) use brief::Brief;
pub use cells::CellList;
pub(crate) use closure::moment;
pub use closure::{Closure, ClosureError};
pub use crossings::{Crossing, Crossings};
pub use curve_geometry::{CurveGeometry, GeometryError};
pub use embedding::{Embedding, Placement};
pub use gradation::follow_scales;
pub use grading::Grading;
pub use grading_error::GradingError;
pub use grid::{Complex64, PeriodicGrid};
pub use measures::enclosed_area;
pub use resampling::{resample, resample_spectrum};
pub use scattered_points::ScatteredPoints;
pub use spectral::SpectralLayout;
pub use state::{Layout, StateRef};
