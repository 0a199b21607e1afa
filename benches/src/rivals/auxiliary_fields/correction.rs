//! What second differences miss at high modes: the root of the ratio of the symbols, on both sides of the band.

use flow_core::flow::GradientFlow;
use flow_core::geometry::Complex64;

/// Factors by field and mode; one for the central family of order 2.
#[derive(Clone, Debug)]
pub struct Correction {
    modes: usize,
    factors: Vec<f64>,
}

impl Correction {
    /// Factors of one.
    pub fn new(fields: usize, modes: usize) -> Self {
        Self { modes, factors: vec![1.0; fields * modes] }
    }

    /// Sets the factors at the frozen state of `flow`, with the coefficients at their means.
    pub fn set(&mut self, flow: &mut GradientFlow, gamma: f64) {
        let nodes = flow.layout().nodes() as f64;
        let length = flow.frozen().length();
        let exact = flow.derivative().minus_laplacian().to_vec();
        for (field, factors) in self.factors.chunks_exact_mut(self.modes).enumerate() {
            let second = flow.energy_terms().jet().second(field, field);
            let mean = (second.iter().sum::<f64>() / nodes).max(0.0);
            let stiffness = flow.energy_terms().stiffness()[field];
            let symbol = |laplacian: f64| {
                let square = laplacian / (length * length);
                let mobility = match field {
                    0 => square * square,
                    _ => flow.density_mobilities()[field - 1].symbol(laplacian, length),
                };
                1.0 + gamma * mobility * (stiffness * square + mean)
            };
            for (mode, factor) in factors.iter_mut().enumerate() {
                let differences = (2.0 * nodes * (std::f64::consts::PI * mode as f64 / nodes).sin()).powi(2);
                *factor = (symbol(differences) / symbol(exact[mode])).sqrt();
            }
        }
    }

    /// Multiplies the spectra of all fields by the factors.
    pub fn apply(&self, spectra: &mut [Complex64]) {
        for (value, factor) in spectra.iter_mut().zip(&self.factors) {
            *value *= *factor;
        }
    }
}
