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
pub use table::Energy;
