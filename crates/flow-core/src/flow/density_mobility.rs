//! Density mobilities 𝓖: self-adjoint, ≥ 0. See `THEORY.md`, eq. (F5).

use serde::{Deserialize, Serialize};

/// How the chemical potential ∂_ρ𝓕 drives a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DensityMobility {
    /// −`Δ_s`: mass is conserved.
    Diffusion,
}

impl DensityMobility {
    /// Symbol of 𝓖 on a curve of the given length, for the symbol of −∂_s² per unit parameter.
    #[must_use]
    pub fn symbol(self, minus_laplacian: f64, length: f64) -> f64 {
        match self {
            Self::Diffusion => minus_laplacian / (length * length),
        }
    }
}
