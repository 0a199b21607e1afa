//! Density mobilities 𝓖: self-adjoint, ≥ 0. See `THEORY.md`, eqs. (F5) and (F14)–(F16).
//!
//! A new one is a file here, a name in `run/scene/density.rs` and a line in `run/mobilities.rs`.

mod carried;
mod diffusion;
mod exchange;
mod weighted_diffusion;

use std::fmt::Debug;

use super::curve_fields::CurveFields;
use crate::geometry::Complex64;

pub use carried::Carried;
pub use diffusion::Diffusion;
pub use exchange::Exchange;
pub use weighted_diffusion::WeightedDiffusion;

/// Turns the chemical potential ∂_ρ𝓕 into the rate of a density: Dρ/Dt = −𝓖∂_ρ𝓕. See `THEORY.md`, eqs. (F5), (F6) and (F17).
///
/// 𝓖 must be self-adjoint and ≥ 0, ⟨μ, 𝓖ν⟩ = ⟨𝓖μ, ν⟩ and ⟨μ, 𝓖μ⟩ ≥ 0 in the mean over the curve, exactly on the grid: the energy is lost
/// at the rate ⟨∂_ρ𝓕, 𝓖∂_ρ𝓕⟩|Γ| by it, and a step that gains energy is refused. The symbol and [`DensityMobility::three_points`] serve the
/// preconditioners alone: where they are off solves take longer, and results stay.
pub trait DensityMobility: Debug + Send + Sync {
    /// Whether 𝓖 = 0: the density is only carried along.
    fn is_zero(&self) -> bool {
        false
    }

    /// w𝓖 of the spectrum `potential` into `out`, at the state `at`: per unit parameter and length, with the grading w, 1 on
    /// uniform nodes.
    fn apply(&mut self, at: &CurveFields, potential: &[Complex64], out: &mut [Complex64]);

    /// Symbol of 𝓖 with its coefficients frozen at their means, for the symbol of −∂_s² per unit parameter.
    fn symbol(&self, minus_laplacian: f64, length: f64) -> f64;

    /// Order of 𝓖 as a differential operator.
    fn order(&self) -> usize;

    /// Whether it moves the density at all, and without derivatives: then what errors leave fades no faster than the potential relaxes it.
    fn relaxes(&self) -> bool {
        self.order() == 0 && !self.is_zero()
    }

    /// Second-order approximation of 𝓖 at the state `at`, at node `node` of `nodes` graded alike: weights of the left neighbour, the
    /// node, the right one.
    fn three_points(&self, at: &CurveFields, node: usize, nodes: usize) -> [f64; 3];

    /// Whether the mass ∫ρ dσ is kept, whatever the energy.
    fn conserves_mass(&self) -> bool;
}
