//! What a Newton correction leaves in the stiff modes of the curvature, made good mode by mode.
//!
//! Fronts that move by δρ leave ½ ∂³𝓕/∂κ∂ρ² δρ² in the force on the curvature. It is small, but 𝓚 makes a large rate of it, which
//! the dissipation sees. The stiff modes of the curvature follow the densities at once, by their own symbol: where nodes are
//! equidistant and the curvature has a cost of slopes, its principal part has no variable coefficient. See `THEORY.md`, eq. (I2).

use super::super::gradient_flow::GradientFlow;
use super::fourier::diagonal_symbol;
use crate::geometry::SpectralLayout;
use crate::geometry::vectors::mean;

/// The symbol of −J from the curvature to itself, σ by mode; none where it does not settle the curvature.
#[derive(Clone, Debug, Default)]
pub struct StiffCurvature {
    symbol: Vec<f64>,
}

impl StiffCurvature {
    /// Takes the symbol at the frozen state of `flow`.
    pub fn set(&mut self, flow: &mut GradientFlow) {
        self.symbol.clear();
        if !flow.is_equidistant() || flow.energy_terms().implicit_stiffness()[0] == 0.0 {
            return;
        }
        let second = mean(flow.energy_terms().jet().second(0, 0)).max(0.0);
        for mode in 0..flow.spectral_layout().modes() {
            let laplacian = flow.grid_and_derivative().1.minus_laplacian()[mode];
            self.symbol.push(diagonal_symbol(flow, 0, laplacian, second));
        }
    }

    /// Overwrites the residual `r` of a stage with γ by the change of the curvature that takes back its stiff part,
    /// r γσ/(1 + γσ)², and of nothing else; false if that does not settle it.
    pub fn settle(&self, layout: SpectralLayout, gamma: f64, r: &mut [f64]) -> bool {
        if self.symbol.is_empty() {
            return false;
        }
        let curvature = layout.field(0);
        r[curvature.end..].fill(0.0);
        let (modes, _) = r[curvature].as_chunks_mut::<2>();
        for (mode, symbol) in modes.iter_mut().zip(&self.symbol) {
            let stiffness = gamma * symbol;
            let part = stiffness / ((1.0 + stiffness) * (1.0 + stiffness));
            *mode = mode.map(|value| value * part);
        }
        true
    }
}
