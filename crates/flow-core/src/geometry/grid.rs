//! The periodic grid and its discrete Fourier transform.

use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

pub use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// `n` equidistant nodes of the unit parameter circle, and the transforms between nodal values
/// and Fourier coefficients (`THEORY.md`, eq. (D1)).
#[derive(Clone)]
pub struct PeriodicGrid {
    nodes: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    values: Vec<f64>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for PeriodicGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PeriodicGrid {{ nodes: {} }}", self.nodes)
    }
}

impl PeriodicGrid {
    /// A grid of `nodes` ≥ 2 nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        assert!(nodes >= 2, "a periodic grid needs two nodes");
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(nodes);
        let inverse = planner.plan_fft_inverse(nodes);
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self {
            nodes,
            forward,
            inverse,
            values: vec![0.0; nodes],
            scratch: vec![Complex64::default(); scratch],
        }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of Fourier coefficients of a real nodal field.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.nodes / 2 + 1
    }

    /// The mode n/2, present on even grids only, whose sine part is invisible at the nodes.
    #[must_use]
    pub fn sawtooth_mode(&self) -> Option<usize> {
        self.nodes.is_multiple_of(2).then_some(self.nodes / 2)
    }

    /// Wave number 2πj of mode `j`, per unit parameter.
    #[must_use]
    pub fn wave_number(&self, mode: usize) -> f64 {
        TAU * mode as f64
    }

    /// How often a mode of the half spectrum stands in the full one: 1 for the mean and the sawtooth, else 2.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        if mode == 0 || Some(mode) == self.sawtooth_mode() { 1.0 } else { 2.0 }
    }

    /// Fourier coefficients of nodal values; the coefficient 0 is the mean.
    pub fn transform(&mut self, values: &[f64], spectrum: &mut [Complex64]) {
        let scale = 1.0 / self.nodes as f64;
        for (copy, value) in self.values.iter_mut().zip(values) {
            *copy = scale * value;
        }
        let done = self.forward.process_with_scratch(&mut self.values, spectrum, &mut self.scratch);
        assert!(done.is_ok(), "lengths are fixed when the grid is built");
    }

    /// Nodal values of Fourier coefficients, which are used up.
    pub fn synthesise(&mut self, spectrum: &mut [Complex64], values: &mut [f64]) {
        self.make_real(spectrum);
        let done = self.inverse.process_with_scratch(spectrum, values, &mut self.scratch);
        assert!(done.is_ok(), "lengths are fixed when the grid is built");
    }
    /// Sets the imaginary parts of mean and sawtooth to zero, as those of real fields are, in consecutive spectra. The rounding
    /// of symbols must not leave any: no implicit operator acts on them, and no solve could reduce them.
    pub fn make_real(&self, spectra: &mut [Complex64]) {
        for spectrum in spectra.chunks_exact_mut(self.modes()) {
            spectrum[0].im = 0.0;
            if let Some(sawtooth) = self.sawtooth_mode() {
                spectrum[sawtooth].im = 0.0;
            }
        }
    }
}
