//! Weights of residuals r = b − (I − γJ)x, between the two that are of interest.
//!
//! A residual r of a stiff mode with symbol 1 + γσ is an error r/(1 + γσ) of the state, but an error r/γ of the rate,
//! which enters the dissipation. (1 + γσ)^{−1/4} keeps both small and does not ask for more. See `THEORY.md`, eq. (I3).

use super::super::gradient_flow::GradientFlow;
use super::fourier::mobility_symbol;
use crate::geometry::SpectralLayout;
use crate::geometry::vectors::multiply;

/// Weights by coefficient of a spectral state, and their inverses.
#[derive(Clone, Debug)]
pub struct ResidualWeights {
    weights: Vec<f64>,
    inverses: Vec<f64>,
}

impl ResidualWeights {
    /// Weights of one.
    #[must_use]
    pub fn new(layout: SpectralLayout) -> Self {
        Self { weights: vec![1.0; layout.len()], inverses: vec![1.0; layout.len()] }
    }

    /// Takes the symbols at the frozen state of `flow`, without the variable coefficients.
    pub fn set(&mut self, flow: &mut GradientFlow, gamma: f64) {
        let (layout, length) = (flow.spectral_layout(), flow.symbol_length());
        for place in 0..flow.layout().state_fields() {
            // The metric moves as stiffly as the curvature.
            let field = if Some(place) == flow.layout().metric() { 0 } else { place };
            let stiffness = flow.energy_terms().stiffness()[field] / (length * length);
            let start = layout.field(place).start;
            for mode in 0..layout.modes() {
                let laplacian = flow.grid_and_derivative().1.minus_laplacian()[mode];
                let rate = mobility_symbol(flow, field, laplacian, length) * stiffness * laplacian;
                let inverse = (1.0 + gamma * rate).sqrt().sqrt();
                for entry in [start + 2 * mode, start + 2 * mode + 1] {
                    self.inverses[entry] = inverse;
                    self.weights[entry] = 1.0 / inverse;
                }
            }
        }
    }

    /// Multiplies `r` by the weights.
    pub fn weigh(&self, r: &mut [f64]) {
        multiply(r, &self.weights);
    }

    /// Divides `r` by the weights.
    pub fn unweigh(&self, r: &mut [f64]) {
        multiply(r, &self.inverses);
    }
}
