//! Gradient flows of energies of closed planar curves that carry embedded densities.

pub mod expression;
pub mod run;
