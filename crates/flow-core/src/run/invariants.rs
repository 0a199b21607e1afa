//! What a flow keeps exactly, put back after each step: masses, length, enclosed area. See `THEORY.md`, eq. (F13).
//!
//! Masses and length are linear invariants, which the integrator keeps up to the rounding and the solves of each step;
//! the area is quadratic, and drifts with the error of the steps.

use serde::{Deserialize, Serialize};

use crate::flow::{GradientFlow, Kept};
use crate::geometry::{Closure, ClosureError, Complex64, SpectralLayout, enclosed_area, moment};

/// Area, relative to that of a circle of the same length, up to which the difference is rounding.
const HELD: f64 = 1e-14;
/// Area, relative to that of the circle, from which on a change of scale may restore it.
const SCALABLE: f64 = 0.05;
/// Share of |γ|² that the closure does not see, below which the curve is a circle and its area fixed by its length.
const ROUND: f64 = 1e-20;
const MOST_CORRECTIONS: usize = 4;

/// The kept quantities of one flow.
#[derive(Clone, Debug)]
pub struct Invariants {
    layout: SpectralLayout,
    /// Index of the mean of the metric, if that is a field: the fields end with it.
    mean_metric: Option<usize>,
    kept: Kept,
    /// Mean coefficients of the densities, and which of them are masses that are kept.
    masses: Vec<(bool, f64)>,
    length: f64,
    area: f64,
    taken: bool,
    square: Vec<Complex64>,
    values: Vec<f64>,
}

/// Values of the kept quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptValues {
    taken: bool,
    masses: Vec<f64>,
    length: f64,
    area: f64,
}

impl Invariants {
    /// The quantities that `flow` keeps; their values are those of the first state restored.
    #[must_use]
    pub fn new(flow: &mut GradientFlow) -> Self {
        let layout = flow.spectral_layout();
        Self {
            layout,
            mean_metric: flow.layout().metric().map(|field| layout.field(field).start),
            kept: flow.normal_mobility().keeps(),
            masses: flow.density_mobilities().iter().map(|d| (d.conserves_mass(), 0.0)).collect(),
            length: 0.0,
            area: 0.0,
            taken: false,
            square: vec![Complex64::default(); layout.modes()],
            values: vec![0.0; flow.layout().nodes()],
        }
    }

    /// Puts the spectral state `y` back onto closed curves with the quantities kept; returns the gap before.
    ///
    /// # Errors
    /// [`ClosureError`] if the curve does not close.
    pub fn restore(
        &mut self,
        y: &mut [f64],
        flow: &mut GradientFlow,
        closure: &mut Closure,
        turning_number: i32,
        angle: f64,
    ) -> Result<f64, ClosureError> {
        let last = self.layout.length_index();
        if let Some(mean) = self.mean_metric {
            y[last] = y[mean];
        }
        if self.taken {
            self.restore_linear(y);
        } else {
            self.length = y[last];
            for (density, (_, mass)) in self.masses.iter_mut().enumerate() {
                *mass = y[self.layout.field(1 + density).start];
            }
        }
        let modes = self.layout.modes();
        let length = y[last];
        let turning = &mut self.layout.spectra_mut(y)[..modes];
        let gap = closure.project(turning, length, turning_number, angle)?;
        if self.kept.area {
            if !self.taken {
                self.area = area(closure, turning, length, angle);
            }
            self.restore_area(y, flow, closure, turning_number, angle)?;
        }
        self.taken = true;
        Ok(gap)
    }

    /// The values kept; none before the first state was restored.
    #[must_use]
    pub fn kept_values(&self) -> KeptValues {
        let masses = self.masses.iter().map(|(_, mass)| *mass).collect();
        KeptValues { taken: self.taken, masses, length: self.length, area: self.area }
    }

    /// Keeps `values` from now on; false if they are those of other densities.
    pub fn set_kept_values(&mut self, values: KeptValues) -> bool {
        if values.masses.len() != self.masses.len() {
            return false;
        }
        for ((_, mass), value) in self.masses.iter_mut().zip(values.masses) {
            *mass = value;
        }
        (self.length, self.area, self.taken) = (values.length, values.area, values.taken);
        true
    }

    fn restore_linear(&self, y: &mut [f64]) {
        for (density, (kept, mass)) in self.masses.iter().enumerate() {
            if *kept {
                y[self.layout.field(1 + density).start] = *mass;
            }
        }
        if self.kept.length {
            self.set_length(y, self.length);
        }
    }

    /// Changes the scale of the curve at fixed turning.
    fn set_length(&self, y: &mut [f64], length: f64) {
        let last = self.layout.length_index();
        if let Some(mean) = self.mean_metric {
            let ratio = length / y[last];
            y[mean..last].iter_mut().for_each(|g| *g *= ratio);
        }
        y[last] = length;
    }

    /// Corrects the length by a change of scale where it is free, else the curvature.
    fn restore_area(
        &mut self,
        y: &mut [f64],
        flow: &mut GradientFlow,
        closure: &mut Closure,
        turning_number: i32,
        angle: f64,
    ) -> Result<(), ClosureError> {
        let (last, modes) = (self.layout.length_index(), self.layout.modes());
        for _ in 0..MOST_CORRECTIONS {
            let length = y[last];
            let turning = &mut self.layout.spectra_mut(y)[..modes];
            let now = area(closure, turning, length, angle);
            let circle = length * length / (4.0 * std::f64::consts::PI);
            if (now - self.area).abs() <= HELD * circle {
                break;
            }
            let ratio = self.area / now;
            if !self.kept.length && self.area.abs() > SCALABLE * circle && ratio > 0.0 {
                self.set_length(y, length * ratio.sqrt());
                break;
            }
            if !self.bend(y, flow, closure, now - self.area) {
                break;
            }
            let turning = &mut self.layout.spectra_mut(y)[..modes];
            closure.project(turning, length, turning_number, angle)?;
        }
        Ok(())
    }

    /// K += c q, q the part of −∂A/∂K = |γ|²/2 that the closure does not see; δA = −c⟨q²⟩. False on a circle, and on one that is held
    /// where q is so small, the error of the nodes, that c q would change the area more to second order than to first.
    fn bend(
        &mut self,
        state: &mut [f64],
        flow: &mut GradientFlow,
        closure: &mut Closure,
        excess: f64,
    ) -> bool {
        let grid = flow.grid_mut();
        let [x, y] = closure.embedding().position();
        for ((value, x), y) in self.values.iter_mut().zip(x).zip(y) {
            *value = 0.5 * (x * x + y * y);
        }
        grid.transform(&self.values, &mut self.square);
        let whole = self.square[0].re;
        self.square[0] = Complex64::default();
        let q = &mut self.square[1..];
        let [x, y] = closure.embedding().shape_spectra().map(|spectrum| &spectrum[1..]);
        let (xx, xy, yy) = (moment(x, x), moment(x, y), moment(y, y));
        let (qx, qy) = (moment(q, x), moment(q, y));
        let determinant = xx * yy - xy * xy;
        let (a, b) = ((yy * qx - xy * qy) / determinant, (xx * qy - xy * qx) / determinant);
        for ((q, x), y) in q.iter_mut().zip(x).zip(y) {
            *q -= x * a + y * b;
        }
        let square = moment(q, q);
        if square.is_nan() || square <= ROUND * whole * whole {
            return false;
        }
        if square <= excess.abs() * whole && flow.holds_curve(state) {
            return false;
        }
        let factor = excess / square;
        for (turning, q) in self.layout.spectra_mut(state).iter_mut().zip(&self.square) {
            *turning += q * factor;
        }
        true
    }
}

/// Area of the curve with the spectrum `turning` of K; its positions about their mean are in the embedding afterwards.
fn area(closure: &mut Closure, turning: &[Complex64], length: f64, angle: f64) -> f64 {
    let embedding = closure.embedding();
    embedding.set_tangent_spectrum(turning, length, angle);
    embedding.set_position(length, [0.0; 2]);
    enclosed_area(embedding.position(), embedding.tangent(), length)
}
