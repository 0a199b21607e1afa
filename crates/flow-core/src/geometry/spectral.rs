//! The state vector in Fourier coefficients, as the integrator carries it.
//!
//! `[K̂ | m̂¹ | m̂² | … | L]`, each spectrum as pairs of real and imaginary part. Derivatives and the symbols of the
//! implicit solves are diagonal there, so products of the implicit operator need fewer transforms. The mean
//! coefficients are the turning and the masses per unit parameter.

use std::ops::Range;

use super::grid::{Complex64, PeriodicGrid};
use super::resampling::resample_spectrum;
use super::state::Layout;

/// Shape of the spectral state vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectralLayout {
    nodal: Layout,
    modes: usize,
}

impl SpectralLayout {
    /// The spectral form of states of `nodal` layout.
    #[must_use]
    pub fn new(nodal: Layout) -> Self {
        Self { nodal, modes: nodal.modes() }
    }

    /// Number of coefficients of a field.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Length of the vector.
    #[must_use]
    pub fn len(&self) -> usize {
        self.length_index() + 1
    }

    /// Whether the vector is empty: never.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Index of the length |Γ|.
    #[must_use]
    pub fn length_index(&self) -> usize {
        2 * self.modes * self.nodal.state_fields()
    }

    /// Entries of field `field`.
    #[must_use]
    pub fn field(&self, field: usize) -> Range<usize> {
        2 * self.modes * field..2 * self.modes * (field + 1)
    }

    /// The coefficients of field `field` among the spectra of all fields.
    #[must_use]
    pub fn spectrum(&self, field: usize) -> Range<usize> {
        self.nodal.spectrum(field)
    }

    /// Panics unless `state` is as long as such a vector.
    #[track_caller]
    pub(crate) fn check(&self, state: &[f64]) {
        assert_eq!(state.len(), self.len(), "length of a spectral vector; a nodal one is shorter");
    }

    /// The spectra of all fields, one after the other.
    ///
    /// # Panics
    /// If `state` is no vector of this layout, but a nodal one, for example.
    #[must_use]
    #[track_caller]
    pub fn spectra<'a>(&self, state: &'a [f64]) -> &'a [Complex64] {
        self.check(state);
        bytemuck::cast_slice(&state[..self.length_index()])
    }

    /// The spectra of all fields, to be changed.
    ///
    /// # Panics
    /// As [`SpectralLayout::spectra`].
    #[must_use]
    #[track_caller]
    pub fn spectra_mut<'a>(&self, state: &'a mut [f64]) -> &'a mut [Complex64] {
        self.check(state);
        bytemuck::cast_slice_mut(&mut state[..self.length_index()])
    }

    /// The spectral `state` as one of the layout `to`, which has the same fields on another number of nodes, at the same
    /// parameter s. Means are kept; modes that `to` does not hold are lost.
    #[must_use]
    pub fn resampled(&self, state: &[f64], to: &Self) -> Vec<f64> {
        let mut out = vec![0.0; to.len()];
        let (nodes, new_nodes) = (self.nodal.nodes(), to.nodal.nodes());
        let targets = to.spectra_mut(&mut out).chunks_exact_mut(to.modes);
        for (target, spectrum) in targets.zip(self.spectra(state).chunks_exact(self.modes)) {
            resample_spectrum(nodes, spectrum, new_nodes, target);
        }
        out[to.length_index()] = state[self.length_index()];
        out
    }

    /// Transforms a nodal state vector.
    ///
    /// # Panics
    /// If `nodal` has not the length of the nodal layout, `state` that of this one, or `grid` other nodes.
    #[track_caller]
    pub fn encode(&self, grid: &mut PeriodicGrid, nodal: &[f64], state: &mut [f64]) {
        self.nodal.check(nodal);
        for (field, spectrum) in self.spectra_mut(state).chunks_exact_mut(self.modes).enumerate() {
            grid.transform(&nodal[self.nodal.field(field)], spectrum);
        }
        state[self.length_index()] = nodal[self.nodal.length_index()];
    }

    /// Transforms back to a nodal state vector; `scratch` holds one spectrum.
    ///
    /// # Panics
    /// As [`SpectralLayout::encode`].
    #[track_caller]
    pub fn decode(
        &self,
        grid: &mut PeriodicGrid,
        state: &[f64],
        scratch: &mut [Complex64],
        nodal: &mut [f64],
    ) {
        self.nodal.check(nodal);
        for (field, spectrum) in self.spectra(state).chunks_exact(self.modes).enumerate() {
            scratch.copy_from_slice(spectrum);
            grid.synthesise(scratch, &mut nodal[self.nodal.field(field)]);
        }
        nodal[self.nodal.length_index()] = state[self.length_index()];
    }
}
