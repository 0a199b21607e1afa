//! Measurements that the physics tests assert and that `docs/physics.md` shows; each has the function `measure`.

pub mod adhesion;
pub mod alignment;
pub mod fields;
pub mod figure_eight;
pub mod fit;
pub mod incompressible_limit;
pub mod labelled_pieces;
pub mod stiffness;
pub mod three_flows;
