//! `[energy.*]`: the terms of the energy, one file each. A term that a scene does not name does not exist.

mod adhesion;
mod agents;
mod area;
mod bending;
mod known;
mod length;
mod local;
mod membrane;
mod packing;
mod regularization;
mod start;
mod table;

pub use adhesion::Adhesion;
pub use agents::Agents;
pub use area::{Area, AreaTarget};
pub use bending::Bending;
pub use length::{Length, LengthTarget};
pub use local::Local;
pub use membrane::Membrane;
pub use packing::Packing;
pub use regularization::Regularization;
pub(in crate::run) use start::Start;
pub use table::Energy;

use super::section::Section;
use crate::energies::EnergyTerm;
use crate::expression::ExpressionError;

/// A term; or the key whose derivatives are too large.
type Term = Result<Box<dyn EnergyTerm>, (&'static str, ExpressionError)>;

/// One table `[energy.*]`: how it is read, and what a run asks of it.
trait EnergyTable {
    /// Reads it; `densities` are the names that it may refer to.
    fn read(section: Section<'_>, densities: &[String]) -> Option<Self>
    where
        Self: Sized;

    /// The term that it stands for.
    fn term(&self, start: &Start<'_>) -> Term;

    /// Width of the sharpest fronts that the term makes, if it makes any.
    fn front_width(&self) -> Option<f64> {
        None
    }

    /// What to try where the term takes most of the time, if there is more to say than of any term.
    fn cheaper(&self) -> Option<&'static str> {
        None
    }
}
