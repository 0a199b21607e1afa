//! The periodic grid and its discrete Fourier transform.

use std::f64::consts::TAU;
use std::sync::Arc;

pub use rustfft::num_complex::Complex64;

use super::real_transform::RealTransform;
use super::vectors::turn_back;

/// `n` equidistant nodes of the unit parameter circle, and the transforms between nodal values
/// and Fourier coefficients (`THEORY.md`, eq. (D1)).
#[derive(Clone, Debug)]
pub struct PeriodicGrid {
    nodes: usize,
    transform: RealTransform,
    /// 1/2πj of each mode j, zero for the mean and the sawtooth.
    inverse_wave_numbers: Arc<[f64]>,
}

impl PeriodicGrid {
    /// A grid of `nodes` ≥ 2 nodes.
    ///
    /// # Panics
    /// If there are fewer.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        assert!(nodes >= 2, "a periodic grid needs two nodes");
        let has_inverse = |mode: usize| mode > 0 && 2 * mode != nodes;
        let inverse = |mode: usize| if has_inverse(mode) { 1.0 / (TAU * mode as f64) } else { 0.0 };
        Self {
            nodes,
            transform: RealTransform::new(nodes),
            inverse_wave_numbers: (0..=nodes / 2).map(inverse).collect(),
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

    /// Symbol of the shift by half a node distance; the sawtooth vanishes between the nodes.
    pub(crate) fn half_step(&self, mode: usize) -> Complex64 {
        if Some(mode) == self.sawtooth_mode() {
            return Complex64::default();
        }
        Complex64::cis(0.5 * self.wave_number(mode) / self.nodes as f64)
    }

    /// Values halfway between the nodes of the polynomial with the coefficients `spectrum`.
    pub(super) fn at_midpoints(&mut self, spectrum: &[Complex64]) -> Vec<f64> {
        let half: Vec<Complex64> = spectrum.iter().enumerate().map(|(j, w)| w * self.half_step(j)).collect();
        let mut values = vec![0.0; self.nodes];
        self.synthesise(&half, &mut values);
        values
    }

    /// How often a mode of the half spectrum stands in the full one: 1 for the mean and the sawtooth, else 2.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        Self::multiplicity_on(self.nodes, mode)
    }

    /// [`PeriodicGrid::multiplicity`] on a grid of `nodes` nodes.
    #[must_use]
    pub fn multiplicity_on(nodes: usize, mode: usize) -> f64 {
        if mode == 0 || 2 * mode == nodes { 1.0 } else { 2.0 }
    }

    /// Fourier coefficients of nodal values; the coefficient 0 is the mean.
    ///
    /// # Panics
    /// If there are not [`PeriodicGrid::nodes`] values and [`PeriodicGrid::modes`] coefficients.
    pub fn transform(&mut self, values: &[f64], spectrum: &mut [Complex64]) {
        self.transform.forward(values, spectrum);
    }

    /// Nodal values of Fourier coefficients; those of the mean and of the sawtooth count by their real parts.
    ///
    /// # Panics
    /// As [`PeriodicGrid::transform`].
    pub fn synthesise(&mut self, spectrum: &[Complex64], values: &mut [f64]) {
        self.transform.inverse(spectrum, values);
    }

    /// Divides a spectrum by 2πij: the antiderivative with mean zero. Mean and sawtooth are lost; on nodal values
    /// the map is exactly skew.
    ///
    /// # Panics
    /// If there are not [`PeriodicGrid::modes`] coefficients.
    pub fn integrate(&self, spectrum: &mut [Complex64]) {
        assert_eq!(spectrum.len(), self.modes(), "Fourier coefficients of the grid");
        turn_back(spectrum, &self.inverse_wave_numbers);
        spectrum[0] = Complex64::default();
        if let Some(sawtooth) = self.sawtooth_mode() {
            spectrum[sawtooth] = Complex64::default();
        }
    }

    /// Sets the imaginary parts of mean and sawtooth to zero, as those of real fields are, in consecutive spectra. The rounding
    /// of symbols must not leave any: no implicit operator acts on them, and no solve could reduce them. What is left beyond the last
    /// whole spectrum stays as it is.
    pub fn make_real(&self, spectra: &mut [Complex64]) {
        for spectrum in spectra.chunks_exact_mut(self.modes()) {
            spectrum[0].im = 0.0;
            if let Some(sawtooth) = self.sawtooth_mode() {
                spectrum[sawtooth].im = 0.0;
            }
        }
    }
}
