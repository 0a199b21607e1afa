//! What the motion of the curve does to the densities.

use crate::flow::gradient_flow::GradientFlow;

/// Whether what the motion of the curve does to the densities is of the order of their own mobility.
///
/// To leading order A = T(A₀, 0) with the rate of the curvature A₀ = −|Γ|`Δ_s` and T = (1, 0; A₁A₀⁻¹, 1), so that 𝓚 is
/// T diag(`A₀𝓑A₀ᵀ`, 𝓖)Tᵀ and T⁻¹(I − γJ)T has no coupling through the motion. Where 𝓖 is of order 2 and 𝓑 of order 0 the
/// coupling is small without that. See `THEORY.md`, eq. (O6).
pub fn carries(flow: &GradientFlow) -> bool {
    if flow.layout().metric().is_some() {
        return false; // nodes of a metric that moves carry their densities anyhow
    }
    let least = 2 + flow.normal_mobility().order();
    flow.density_mobilities().iter().any(|density| density.order() < least)
}
