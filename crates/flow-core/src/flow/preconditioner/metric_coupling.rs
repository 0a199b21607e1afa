//! The metric as a field: what the normal velocity makes of it, and the rest, which relabels material points.
//! See `THEORY.md`, eq. (O8).
//!
//! A residual is r = (A u, m) + c, with the normal velocity u that makes its rate of the curvature and c a change of the metric that
//! no normal velocity makes. Nothing moves along the curve: (I − γJ)x = r leaves c as it is, however stiff the answer Jc of the
//! velocity, so that x = c + (A v, m′), with an equation for v and m′ alone.

use super::super::gradient_flow::GradientFlow;
use crate::geometry::Complex64;
use crate::geometry::vectors::{add_scaled, dot, multiply_into, scale};

/// Splits residuals, and converts between rates of the state and the velocities that make them.
#[derive(Clone, Debug)]
pub struct MetricCoupling {
    metric: usize,
    modes: usize,
    gamma: f64,
    /// (A u, m), c and Jc.
    made: Vec<f64>,
    rest: Vec<f64>,
    image: Vec<f64>,
    /// The densities that are only carried: what the nodes have of them does not change at all.
    carried: Vec<usize>,
    /// K and nodal scratch.
    turning: Vec<f64>,
    velocity: Vec<f64>,
    values: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl MetricCoupling {
    /// For the states of `flow`; none if their metric is fixed.
    #[must_use]
    pub fn of(flow: &GradientFlow) -> Option<Self> {
        let layout = flow.spectral_layout();
        let (state, nodes) = (vec![0.0; layout.len()], vec![0.0; flow.layout().nodes()]);
        Some(Self {
            metric: flow.layout().metric()?,
            modes: layout.modes(),
            gamma: 0.0,
            made: state.clone(),
            rest: state.clone(),
            image: state,
            carried: flow.carried_fields().collect(),
            turning: nodes.clone(),
            velocity: nodes.clone(),
            values: nodes,
            spectrum: vec![Complex64::default(); layout.modes()],
        })
    }

    /// Takes γ and the frozen state of `flow`.
    pub fn set(&mut self, flow: &GradientFlow, gamma: f64) {
        self.gamma = gamma;
        let at = flow.frozen();
        multiply_into(&mut self.turning, at.at_nodes(0), at.weight().unwrap_or_default());
        scale(&mut self.turning, at.length());
    }

    /// Turns the right-hand side r of (I − γJ)x = r into that of x − c, which is a motion (A u, m).
    pub fn split(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        let (stretch, last) = (flow.spectral_layout().field(self.metric), r.len() - 1);
        let mut made = std::mem::take(&mut self.made);
        made.copy_from_slice(r);
        self.take_velocity(flow, &mut made);
        self.make_motion(flow, &mut made);
        for i in stretch.clone() {
            self.rest[i] = r[i] - made[i];
        }
        self.rest[last] = self.rest[stretch.start];
        r[stretch.start..].copy_from_slice(&made[stretch.start..]);
        self.made = made;
        flow.spectral_jacobian_product(&self.rest, &mut self.image);
        add_scaled(r, self.gamma, &self.image);
    }

    /// Completes x − c to x.
    pub fn complete(&mut self, flow: &GradientFlow, x: &mut [f64]) {
        add_scaled(x, 1.0, &self.rest);
        for field in &self.carried {
            let range = flow.spectral_layout().field(*field);
            x[range.clone()].copy_from_slice(&self.made[range]);
        }
    }

    /// Replaces the motion (A u, m) by (u, m).
    pub fn take_velocity(&mut self, flow: &mut GradientFlow, motion: &mut [f64]) {
        let layout = flow.spectral_layout();
        let spectra = layout.spectra_mut(motion);
        self.spectrum.copy_from_slice(&spectra[..self.modes]);
        flow.velocity_of_turning(&mut self.spectrum, &mut self.velocity);
        let grid = flow.grid_mut();
        self.spectrum.copy_from_slice(&spectra[layout.spectrum(self.metric)]);
        grid.synthesise(&self.spectrum, &mut self.values);
        // A uniform velocity does not bend; what is left of the stretch tells it.
        for ((value, turning), velocity) in self.values.iter_mut().zip(&self.turning).zip(&self.velocity) {
            *value -= turning * velocity;
        }
        let uniform = dot(&self.turning, &self.values) / dot(&self.turning, &self.turning);
        self.velocity.iter_mut().for_each(|velocity| *velocity += uniform);
        grid.transform(&self.velocity, &mut spectra[..self.modes]);
    }

    /// Replaces (u, m) by the motion (A u, m).
    pub fn make_motion(&mut self, flow: &mut GradientFlow, motion: &mut [f64]) {
        let layout = flow.spectral_layout();
        let spectra = layout.spectra_mut(motion);
        self.spectrum.copy_from_slice(&spectra[..self.modes]);
        let grid = flow.grid_mut();
        grid.synthesise(&self.spectrum, &mut self.velocity);
        multiply_into(&mut self.values, &self.turning, &self.velocity);
        let stretch = &mut spectra[layout.spectrum(self.metric)];
        grid.transform(&self.values, stretch);
        let mean = stretch[0].re;
        flow.turning_of_velocity(&self.spectrum, &mut spectra[..self.modes]);
        motion[layout.length_index()] = mean;
    }
}
