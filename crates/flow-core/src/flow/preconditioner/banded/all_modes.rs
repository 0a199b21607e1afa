//! A band of all modes, as long as rounding lets it be one.

use super::super::fourier::diagonal_symbol;
use super::Banded;
use crate::flow::gradient_flow::GradientFlow;
use crate::geometry::Complex64;
use crate::operators::FactorisationError;

/// Largest condition number of a band whose rounding is below what a preconditioner may be off: fronts on 2304 nodes, where it is 10¹⁵
/// late, took two and a half times the iterations.
const MOST_CONDITION: f64 = 1e12;

/// Two bands, of which one serves at each factorisation: that of all modes, and where it would be ill-conditioned that of the low ones.
#[derive(Debug)]
pub struct AllModes {
    bands: [Box<dyn Banded>; 2],
    serving: usize,
}

impl AllModes {
    /// Of a band of the `low` modes and one of `all`.
    pub fn new(low: Box<dyn Banded>, all: Box<dyn Banded>) -> Self {
        Self { bands: [low, all], serving: 0 }
    }
}

/// Condition number of I − γJ: that of its symbol.
fn condition(flow: &GradientFlow, gamma: f64) -> f64 {
    let highest = flow.derivative().minus_laplacian().iter().copied().fold(0.0, f64::max);
    let symbol = |field| diagonal_symbol(flow, field, highest, flow.energy_terms().convex_mean(field));
    1.0 + gamma * (0..flow.layout().fields()).map(symbol).fold(0.0, f64::max)
}

impl Banded for AllModes {
    fn modes(&self) -> usize {
        self.bands[self.serving].modes()
    }

    fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError> {
        self.serving = usize::from(condition(flow, gamma) < MOST_CONDITION);
        self.bands[self.serving].factorise(flow, gamma)
    }

    fn apply(&mut self, spectra: &mut [Complex64]) {
        self.bands[self.serving].apply(spectra);
    }
}
