//! Normal mobilities 𝓑: self-adjoint, ≥ 0. See `THEORY.md`, eqs. (F4) and (F8)–(F13).
//!
//! A new one is a file here, a name in `run/scene/flow.rs` and a line in `run/mobilities.rs`.

mod area_preserving;
mod identity;
mod incompressible;
mod incompressible_area_preserving;
mod surface_diffusion;

use std::fmt::Debug;

use super::curve_fields::CurveFields;
use crate::operators::HelmholtzError;

pub use area_preserving::AreaPreserving;
pub use identity::Identity;
pub use incompressible::Incompressible;
pub use incompressible_area_preserving::IncompressibleAreaPreserving;
pub use surface_diffusion::SurfaceDiffusion;

/// A mobility cannot be used at a state.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MobilityError {
    /// The Helmholtz operator has no inverse there.
    #[error(transparent)]
    Helmholtz(#[from] HelmholtzError),
}

/// Global quantities that the flow keeps, whatever the energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    /// The length |Γ|.
    pub length: bool,
    /// The enclosed area.
    pub area: bool,
}

/// Turns the force f on the normal motion into the normal velocity V = 𝓑f; holds what it needs of one state. See `THEORY.md`, eqs. (F4),
/// (F6) and (F17).
///
/// 𝓑 must be self-adjoint and ≥ 0, ⟨f, 𝓑h⟩ = ⟨𝓑f, h⟩ and ⟨f, 𝓑f⟩ ≥ 0 in the mean over the curve ([`CurveFields::mean_of_product`]),
/// exactly on the grid: the energy is lost at the rate ⟨f, 𝓑f⟩|Γ| by it, and a step that gains energy is refused. The symbol serves the
/// preconditioners alone: where it is off solves take longer, and results stay.
pub trait NormalMobility: Debug + Send + Sync {
    /// Whether V = f.
    fn is_identity(&self) -> bool {
        false
    }

    /// Whether 𝓑 = −`Δ_s`.
    fn is_minus_laplacian(&self) -> bool {
        false
    }

    /// Where 𝓑 holds the area that the grid has, and not that of the continuum: room for the force of that area, −Aᵀ of its derivative, near
    /// 1, which is filled in before [`NormalMobility::set`]. Shapes: one value per node.
    fn area_force(&mut self) -> Option<&mut [f64]> {
        None
    }

    /// Prepares 𝓑 at the state `at`, without allocating.
    ///
    /// # Errors
    /// [`MobilityError`] if 𝓑 is not defined there.
    fn set(&mut self, _at: &CurveFields) -> Result<(), MobilityError> {
        Ok(())
    }

    /// V = 𝓑f at the state `at`, that of [`NormalMobility::set`]. Shapes: one value per node.
    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]);

    /// The c with 𝓑(f − c) = 𝓑f that is nearest to `force`, where 𝓑1 = 0: what holds the area; zero else.
    fn area_multiplier(&mut self, at: &CurveFields, force: &[f64]) -> f64 {
        if self.keeps().area { at.mean(force) } else { 0.0 }
    }

    /// Where 𝓑 holds every piece of the curve: φ of V = f − κφ, the tension that does it, into `tension`. Shapes: one value per node.
    fn holding_tension(&mut self, _at: &CurveFields, _force: &[f64], tension: &mut [f64]) {
        tension.fill(0.0);
    }

    /// Symbol of 𝓑 with coefficients frozen at their means, for the symbol k² of −`Δ_s`.
    fn symbol(&self, wave_square: f64) -> f64;

    /// [`NormalMobility::symbol`] of each of `wave_squares`, into `symbols`.
    fn symbols(&self, wave_squares: &[f64], symbols: &mut [f64]) {
        for (symbol, square) in symbols.iter_mut().zip(wave_squares) {
            *symbol = self.symbol(*square);
        }
    }

    /// Order of 𝓑 as a differential operator.
    fn order(&self) -> usize {
        0
    }

    /// Whether 𝓑 = 0 at the state of [`NormalMobility::set`], since what the flow keeps leaves the curve nowhere to go.
    fn holds_curve(&self) -> bool {
        false
    }

    /// What the flow keeps.
    fn keeps(&self) -> Kept {
        Kept::default()
    }

    /// The same mobility for another state.
    fn boxed_clone(&self) -> Box<dyn NormalMobility>;
}
