//! The gradient of an energy by the intrinsic fields and the length.

use crate::geometry::Complex64;

/// Gradient of the energy, as the flow map takes it.
#[derive(Clone, Debug)]
pub struct IntrinsicGradient {
    /// Variational derivatives ∂_κ𝓕, ∂_ρ𝓕 as spectra, one per field, in energy per field and arc length; then ∂_g𝓕 if the metric is a
    /// field.
    pub spectra: Vec<Complex64>,
    /// ∂𝓕/∂|Γ| at fixed K and m, in energy per length; zero if the metric is a field.
    pub by_length: f64,
}

impl IntrinsicGradient {
    /// Overwrites it by `other`, of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.spectra.copy_from_slice(&other.spectra);
        self.by_length = other.by_length;
    }
}
