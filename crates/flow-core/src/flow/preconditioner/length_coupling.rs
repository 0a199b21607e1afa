//! Couples the length into a preconditioner of the fields, exactly for stiff functions of the length.
//!
//! Hess 𝓕 = H₀ + Φ″ e eᵀ with e the direction of |Γ|, so I + `γ𝓚Hess` 𝓕 is a rank-one change of I + `γ𝓚H₀` by
//! γΦ″ (𝓚e) eᵀ: Sherman–Morrison. The row of the length in I + `γ𝓚H₀` is eᵀ + γ(H₀𝓚e)ᵀ. Φ″ is that at the frozen length, which
//! alone tells whether there is anything to couple: it may vanish at any other length, and where it vanishes here nothing is done.

use super::super::gradient_flow::GradientFlow;
use crate::geometry::SpectralLayout;
use crate::geometry::vectors::{add_scaled, dot};

/// The rank-one correction.
#[derive(Clone, Debug)]
pub struct LengthCoupling {
    gamma: f64,
    layout: SpectralLayout,
    /// Index of |Γ|: its own, or that of the mean of the metric where that is a field.
    index: usize,
    of_velocity: bool,
    /// 𝓚e.
    direction: Vec<f64>,
    /// `H₀𝓚e`, each coefficient as often as it stands in the full spectrum: dot products are means.
    row: Vec<f64>,
    /// `P₀𝓚e`.
    response: Vec<f64>,
    /// Φ″ at the frozen state.
    curvature: f64,
}

impl LengthCoupling {
    /// Room for the spectral states of `flow`; where P₀ is one `of_velocity`, it moves the length with the curve.
    #[must_use]
    pub fn new(flow: &GradientFlow, of_velocity: bool) -> Self {
        let layout = flow.spectral_layout();
        let zero = vec![0.0; layout.len()];
        let (direction, row) = (zero.clone(), zero.clone());
        let index = flow.layout().metric().map_or(layout.length_index(), |field| layout.field(field).start);
        Self { gamma: 0.0, layout, index, of_velocity, direction, row, response: zero, curvature: 0.0 }
    }

    /// Sets the coupling at the frozen state, given the inverse of the fields.
    pub fn set(
        &mut self,
        flow: &mut GradientFlow,
        gamma: f64,
        mut inverse: impl FnMut(&mut GradientFlow, &mut [f64]),
    ) {
        let index = self.index;
        self.gamma = gamma;
        self.curvature = flow.energy_terms().of_length(flow.frozen().length()).second;
        if self.curvature == 0.0 {
            return;
        }
        self.row.fill(0.0);
        self.row[index] = 1.0;
        flow.spectral_mobility(&self.row, &mut self.direction);
        flow.spectral_hessian_product(&self.direction);
        let modes = self.layout.modes();
        let row = self.layout.spectra_mut(&mut self.row);
        for (place, (row, dual)) in row.iter_mut().zip(&flow.gradient().spectra).enumerate() {
            *row = dual * flow.multiplicity(place % modes);
        }
        let last = self.layout.length_index();
        self.row[last] = flow.gradient().by_length;
        self.row[index] -= self.curvature * self.direction[index];
        self.response.copy_from_slice(&self.direction);
        inverse(flow, &mut self.response);
        let mut response = std::mem::take(&mut self.response);
        self.couple_row(&mut response);
        self.response = response;
    }

    /// Completes x = P₀r by the row of the length, unless P₀ has moved the length.
    fn couple_row(&self, x: &mut [f64]) {
        let (index, own) = (self.index, self.row[self.index]);
        if self.of_velocity {
            return;
        }
        let sum = dot(&self.row, x) - own * x[index];
        x[index] = (x[index] - self.gamma * sum) / (1.0 + self.gamma * own.max(0.0));
    }

    /// Completes the preconditioned fields in place.
    pub fn apply(&self, x: &mut [f64]) {
        if self.curvature == 0.0 {
            return;
        }
        self.couple_row(x);
        let weight = self.gamma * self.curvature;
        let factor = weight * x[self.index] / (1.0 + weight * self.response[self.index]);
        add_scaled(x, -factor, &self.response);
    }
}
