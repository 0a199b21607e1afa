//! The core's solver for bending alone, with all that other scenes need taken out: no lists of terms, no jets, no fields but
//! the curvature, no mobility, no weights, no choices.
//!
//! It does what is left in the same order, and so takes the same steps to the last bit; what it saves in time is what the
//! core pays for being general.

mod bending;

use std::ops::Range;

use flow_core::geometry::vectors::{mean_of_product, sum};
use flow_core::geometry::{Closure, Complex64, Layout, SpectralLayout};
use flow_core::integrator::{Finish, INTEGRALS, LinearPart, Problem};

use bending::BendingFlow;

/// A closed curve under (b/2)∫κ² dσ and the L² flow, on nodes at equal distances.
#[derive(Debug)]
pub struct BendingOnly {
    flow: BendingFlow,
    layout: SpectralLayout,
    closure: Closure,
    tangential: Vec<f64>,
    /// (I − γJ)⁻¹ with the coefficients frozen at their means, by mode.
    inverse: Vec<f64>,
    start_angle: f64,
    placed: [f64; 3],
    candidate_angle_rate: f64,
    /// Whether it has a linear part, and so the steps are exponential.
    has_linear_part: bool,
}

impl BendingOnly {
    /// On `nodes` nodes, with the rigidity b; curves are placed at the mean tangent angle `angle`.
    #[must_use]
    pub fn new(nodes: usize, rigidity: f64, angle: f64) -> Self {
        let flow = BendingFlow::new(nodes, rigidity);
        Self {
            layout: SpectralLayout::new(Layout::new(nodes, 0)),
            closure: Closure::new(nodes),
            tangential: vec![0.0; nodes],
            inverse: vec![1.0; flow.modes()],
            start_angle: angle,
            placed: [0.0, angle, 0.0],
            candidate_angle_rate: 0.0,
            has_linear_part: false,
            flow,
        }
    }

    /// The same for exponential steps.
    #[must_use]
    pub fn with_linear_part(self) -> Self {
        Self { has_linear_part: true, ..self }
    }

    fn integral_rates(&mut self, dissipation: f64) -> [f64; INTEGRALS] {
        self.flow.tangential_velocity(&mut self.tangential);
        let [tx, ty] = self.closure.embedding().tangent();
        let (v, w) = (self.flow.velocity(), &self.tangential);
        let angle = mean_of_product(self.flow.curvature(), w);
        let x = mean_of_product(v, ty) + mean_of_product(w, tx);
        let y = mean_of_product(w, ty) - mean_of_product(v, tx);
        [dissipation, angle, x, y]
    }
}

impl Problem for BendingOnly {
    fn size(&self) -> usize {
        self.layout.len()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        vec![self.layout.field(0), self.layout.length_index()..self.layout.len()]
    }

    fn block_floor(&self, block: usize, _: &[f64]) -> f64 {
        if block == 0 { 1.0 } else { f64::MIN_POSITIVE }
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.flow.evaluate(y);
        // The core tells the dissipation of every rate.
        let _ = self.flow.dissipation();
        self.flow.write_rates(rate);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.flow.evaluate(y);
        self.flow.freeze();
        self.flow.write_rates(rate);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.flow.frozen_hessian_product(v);
        self.flow.write_frozen_rates(out);
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.flow.invert_symbol(gamma, &mut self.inverse);
        true
    }

    fn precondition(&mut self, r: &mut [f64]) {
        let turning: &mut [Complex64] = self.layout.spectra_mut(r);
        for (value, inverse) in turning.iter_mut().zip(&self.inverse) {
            *value *= *inverse;
        }
    }

    fn rests_with_its_energy(&self) -> bool {
        true
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        let length = y[self.layout.length_index()];
        let [start, angle, angle_rate] = self.placed;
        if !(length > 0.0 && sum(y).is_finite()) {
            return Finish::NotFinite;
        }
        let angle = angle + (time - start) * angle_rate;
        if self.closure.project(self.layout.spectra_mut(y), length, 1, angle).is_err() {
            return Finish::NotFinite;
        }
        let energy = self.flow.evaluate(y);
        let dissipation = self.flow.dissipation();
        if !(energy.is_finite() && dissipation.is_finite()) {
            return Finish::NotFinite;
        }
        let integral_rates = self.integral_rates(dissipation);
        self.candidate_angle_rate = integral_rates[1];
        Finish::Good { energy, integral_rates }
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        Some(self.flow.energy_slope(direction))
    }

    fn finished_rate(&mut self, _: &[f64], rate: &mut [f64]) {
        self.flow.write_rates_at_hand(rate);
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        if !self.has_linear_part {
            return false;
        }
        self.flow.evaluate(y);
        self.flow.freeze();
        part.clear(1, self.flow.modes());
        for (mode, rate) in self.flow.eigenvalues().enumerate() {
            part.set_eigenvector(mode, 0, rate, &[1.0], &[1.0]);
        }
        part.fits(y.len()) && part.rates()[2 * self.flow.modes() - 1] <= 0.0
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.placed = [time, self.start_angle + integrals[1], self.candidate_angle_rate];
    }
}
