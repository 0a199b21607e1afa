//! `[energy.*]`: the terms of the energy, one file each. A term that a scene does not name does not exist.

mod agents;
mod bending;
mod length;
mod local;
mod regularization;
mod table;

pub use agents::Agents;
pub use bending::Bending;
pub use length::{Length, LengthTarget};
pub use local::Local;
pub use regularization::Regularization;
pub use table::Energy;
