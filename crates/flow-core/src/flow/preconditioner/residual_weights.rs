//! Weights of residuals r = b − (I − γJ)x, between the two that are of interest.
//!
//! A residual r of a stiff mode with symbol 1 + γσ is an error r/(1 + γσ) of the state, but an error r/γ of the rate,
//! which enters the dissipation. (1 + γσ)^{−3/8} keeps both small and does not ask for more; in the curvature ^{−5/8} does, where
//! what is left settles at no cost (see [`super::stiff_curvature`]). Where nodes crowd, σ, a mean, is far below the stiffness there,
//! and (1 + γσ)^{−1/4} does that. What is left of a density that exchanges fades no faster than its own potential relaxes it. See
//! `THEORY.md`, eq. (I3).

use super::super::gradient_flow::GradientFlow;
use super::fourier::diagonal_symbol;
use crate::geometry::SpectralLayout;
use crate::geometry::vectors::multiply;

/// The residual of a density that exchanges counts this much more.
const OF_EXCHANGE: f64 = 16.0;

/// Weights by coefficient of a spectral state, and their inverses.
#[derive(Clone, Debug)]
pub struct ResidualWeights {
    weights: Vec<f64>,
    inverses: Vec<f64>,
    /// Whether any of them is not one: no symbol is stiff without a cost of slopes.
    any: bool,
    /// γσ of one field, by mode.
    stiffness: Vec<f64>,
}

impl ResidualWeights {
    /// Weights of one.
    #[must_use]
    pub fn new(layout: SpectralLayout) -> Self {
        let ones = vec![1.0; layout.len()];
        Self { weights: ones.clone(), inverses: ones, any: false, stiffness: vec![0.0; layout.modes()] }
    }

    /// Takes the symbols at the frozen state of `flow`, without the variable coefficients.
    pub fn set(&mut self, flow: &GradientFlow, gamma: f64) {
        let layout = flow.spectral_layout();
        self.any = false;
        let equidistant = flow.is_equidistant();
        for place in 0..flow.layout().state_fields() {
            // The metric moves as stiffly as the curvature.
            let field = if Some(place) == flow.layout().metric() { 0 } else { place };
            let entries = layout.field(place);
            if flow.energy_terms().implicit_stiffness()[field] == 0.0 {
                // It may have had one before: the weights are those of this state, whatever came before.
                self.inverses[entries.clone()].fill(1.0);
                self.weights[entries].fill(1.0);
                continue;
            }
            self.any = true;
            for (stiffness, laplacian) in self.stiffness.iter_mut().zip(flow.derivative().minus_laplacian()) {
                *stiffness = gamma * diagonal_symbol(flow, field, *laplacian, 0.0);
            }
            let (inverses, _) = self.inverses[entries.clone()].as_chunks_mut::<2>();
            let (weights, _) = self.weights[entries].as_chunks_mut::<2>();
            let more =
                if field > 0 && flow.density_mobilities()[field - 1].relaxes() { OF_EXCHANGE } else { 1.0 };
            // A loop of its own, so that the roots are taken in whole vector registers.
            for ((inverse, weight), stiffness) in inverses.iter_mut().zip(weights).zip(&self.stiffness) {
                let half = (1.0 + stiffness).sqrt();
                let quarter = half.sqrt();
                let root = match (equidistant, field) {
                    (false, _) => quarter,
                    (true, 0) => half * quarter.sqrt(),
                    (true, _) => quarter * quarter.sqrt(),
                };
                *inverse = [root / more; 2];
                *weight = [more / root; 2];
            }
        }
    }

    /// Multiplies `r` by the weights.
    pub fn weigh(&self, r: &mut [f64]) {
        if self.any {
            multiply(r, &self.weights);
        }
    }

    /// Divides `r` by the weights.
    pub fn unweigh(&self, r: &mut [f64]) {
        if self.any {
            multiply(r, &self.inverses);
        }
    }
}
