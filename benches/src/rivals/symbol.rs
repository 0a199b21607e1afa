//! The principal part of the flow with coefficients frozen at their means: one small block per Fourier mode.

use flow_core::flow::GradientFlow;
use flow_core::geometry::Complex64;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::exponential::Weights;

/// Blocks −D S per mode, D the diagonal of the mobilities and S symmetric, in their real eigenbasis.
#[derive(Clone, Debug, Default)]
pub struct Symbol {
    fields: usize,
    modes: usize,
    /// Eigenvalues, `fields` per mode.
    rates: Vec<f64>,
    /// D^{1/2}Q and QᵀD^{-1/2}, row by row, per mode.
    from_eigen: Vec<f64>,
    to_eigen: Vec<f64>,
}

/// A function of the blocks: one matrix per mode, row by row.
pub type BlockFunction = Vec<f64>;

impl Symbol {
    /// The symbol at the state where `flow` was linearised.
    #[must_use]
    pub fn new(flow: &mut GradientFlow) -> Self {
        let fields = flow.layout().fields();
        let length = flow.frozen().length();
        let laplacian = flow.derivative().minus_laplacian().to_vec();
        let jet = flow.energy_terms().jet();
        let mean = |a: usize, b: usize| jet.second(a, b).iter().sum::<f64>() / jet.second(a, b).len() as f64;
        let means = DMatrix::from_fn(fields, fields, mean);
        let stiffness = DVector::from_column_slice(flow.energy_terms().stiffness());
        let mut symbol = Self { fields, modes: laplacian.len(), ..Self::default() };
        for minus_laplacian in laplacian {
            let square = minus_laplacian / (length * length);
            let root = DVector::from_fn(fields, |field, _| match field {
                0 => square * flow.normal_mobility().symbol(square).sqrt(),
                _ => flow.density_mobilities()[field - 1].symbol(minus_laplacian, length).sqrt(),
            });
            let hessian = &means + DMatrix::from_diagonal(&(&stiffness * square));
            let eigen = SymmetricEigen::new(DMatrix::from_fn(fields, fields, |a, b| {
                -root[a] * hessian[(a, b)] * root[b]
            }));
            symbol.rates.extend(eigen.eigenvalues.iter());
            // A mode without mobility has the eigenvalue 0: any basis serves.
            let scale = root.map(|root| if root > 0.0 { root } else { 1.0 });
            for a in 0..fields {
                for b in 0..fields {
                    symbol.from_eigen.push(scale[a] * eigen.eigenvectors[(a, b)]);
                    symbol.to_eigen.push(eigen.eigenvectors[(b, a)] / scale[b]);
                }
            }
        }
        symbol
    }

    /// A function of the blocks from its values at the eigenvalues.
    pub fn function(&self, values: impl Fn(usize) -> f64) -> BlockFunction {
        let (fields, block) = (self.fields, self.fields * self.fields);
        let mut function = vec![0.0; self.modes * block];
        for mode in 0..self.modes {
            let (from, to) = (&self.from_eigen[mode * block..], &self.to_eigen[mode * block..]);
            for a in 0..fields {
                for b in 0..fields {
                    function[mode * block + a * fields + b] = (0..fields)
                        .map(|k| from[a * fields + k] * values(mode * fields + k) * to[k * fields + b])
                        .sum();
                }
            }
        }
        function
    }

    /// The weights of ETDRK4 for steps of `size`, by eigenvalue.
    #[must_use]
    pub fn weights(&self, size: f64) -> Vec<Weights> {
        self.rates.iter().map(|rate| Weights::at(size * rate)).collect()
    }

    /// The eigenvalues.
    #[must_use]
    pub fn rates(&self) -> &[f64] {
        &self.rates
    }
}

/// out += factor × function(spectra), mode by mode.
pub fn add_function(
    function: &[f64],
    modes: usize,
    factor: f64,
    spectra: &[Complex64],
    out: &mut [Complex64],
) {
    let fields = spectra.len() / modes;
    for (mode, block) in function.chunks_exact(fields * fields).enumerate() {
        for a in 0..fields {
            for b in 0..fields {
                out[a * modes + mode] += spectra[b * modes + mode] * (factor * block[a * fields + b]);
            }
        }
    }
}
