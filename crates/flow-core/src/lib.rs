//! Gradient flows of energies of closed planar curves that carry embedded densities.

pub mod energies;
pub mod expression;
pub mod flow;
pub mod geometry;
pub mod integrator;
pub mod operators;
pub mod output;
pub mod run;
