//! Surface diffusion of a curve with densities, and any flow of one with densities that exchange, as an equation of the normal velocity.
//! See `THEORY.md`, eq. (O11).
//!
//! A residual is r = A u + (0, ν) + c, with the normal velocity u that makes its curvature and its length, by the displacement that its
//! change of the tangent makes, and c what none makes. What the force makes of a normal velocity is local, whatever the gauge is, where
//! what it makes of a change of the curvature at fixed nodes is not: the nodes slide.

use std::f64::consts::TAU;

use bytemuck::{cast_slice, cast_slice_mut};

use super::super::gradient_flow::GradientFlow;
use super::stiff_exchange::StiffExchange;
use crate::geometry::vectors::{add_scaled, mean_of_product, multiply, scale_into, shift};
use crate::geometry::{Complex64, Embedding};
use crate::operators::DerivativeFamily;

/// Splits residuals, and converts between rates of the state and the velocities that make them.
#[derive(Clone, Debug)]
pub struct NormalMotion {
    gamma: f64,
    /// The densities that are only carried: what V does not make of them stays as it is.
    carried: Vec<usize>,
    embedding: Embedding,
    /// Components of |Γ|w times the tangent at the nodes, and of the tangent.
    steps: [Vec<f64>; 2],
    tangent: [Vec<f64>; 2],
    /// Spectra of the coordinates, of which a change of the curvature opens the curve, the angles that they make, and the inverse of how
    /// much they open it.
    openings: [Vec<Complex64>; 2],
    turns: [Vec<f64>; 2],
    closing: [[f64; 2]; 2],
    /// What is no motion, and what velocities make.
    rest: Vec<f64>,
    made: Vec<f64>,
    /// Nodal scratch: the change of the angle, the displacement and the velocity.
    angle: Vec<f64>,
    displacement: [Vec<f64>; 2],
    velocity: Vec<f64>,
    spectrum: Vec<Complex64>,
}

/// Whether densities of `flow` exchange with the surroundings.
fn exchanges(flow: &GradientFlow) -> bool {
    flow.density_mobilities().iter().any(|density| density.relaxes())
}

impl NormalMotion {
    /// Whether `flow` is one of these. Second differences are too far from the displacements for it: (O2) takes fewer iterations there
    /// where the densities do nothing to the curve.
    #[must_use]
    pub fn serves(flow: &GradientFlow) -> bool {
        (flow.normal_mobility().is_minus_laplacian() && flow.layout().densities() > 0 || exchanges(flow))
            && flow.layout().metric().is_none()
            && flow.derivative().family() != DerivativeFamily::Central2
            && StiffExchange::of(flow).is_none()
    }

    /// Whether it does so from the first band on: densities that are only carried keep the errors of other solves.
    #[must_use]
    pub fn is_needed(flow: &GradientFlow) -> bool {
        Self::serves(flow) && flow.carries_over_nodes()
    }

    /// For the states of `flow`; none but where it [`serves`](Self::serves).
    #[must_use]
    pub fn of(flow: &GradientFlow) -> Option<Self> {
        let layout = flow.spectral_layout();
        let (nodes, state) = (vec![0.0; flow.layout().nodes()], vec![0.0; layout.len()]);
        Self::serves(flow).then(|| Self {
            gamma: 0.0,
            carried: flow.carried_fields().collect(),
            embedding: Embedding::graded(flow.layout().nodes(), flow.grading().cloned()),
            steps: [nodes.clone(), nodes.clone()],
            tangent: [nodes.clone(), nodes.clone()],
            openings: std::array::from_fn(|_| vec![Complex64::default(); layout.modes()]),
            turns: [nodes.clone(), nodes.clone()],
            closing: [[0.0; 2]; 2],
            rest: state.clone(),
            made: state,
            angle: nodes.clone(),
            displacement: [nodes.clone(), nodes.clone()],
            velocity: nodes,
            spectrum: vec![Complex64::default(); layout.modes()],
        })
    }

    /// Takes γ and the frozen state of `flow`.
    pub fn set(&mut self, flow: &mut GradientFlow, gamma: f64) {
        self.gamma = gamma;
        let length = flow.frozen().length();
        let spectrum = flow.frozen().weighted_spectrum(0).iter();
        self.spectrum.iter_mut().zip(spectrum).for_each(|(target, value)| *target = value * length);
        self.embedding.set_tangent_spectrum(&self.spectrum, length, 0.0);
        let weighted = self.embedding.tangent();
        for ((step, tangent), weighted) in self.steps.iter_mut().zip(&mut self.tangent).zip(weighted) {
            scale_into(step, length, weighted);
            tangent.copy_from_slice(weighted);
            if let Some(grading) = flow.grading() {
                multiply(tangent, grading.inverse());
            }
        }
        self.set_openings(flow);
    }

    fn set_openings(&mut self, flow: &mut GradientFlow) {
        let grid = flow.grid_mut();
        for ((opening, turns), step) in self.openings.iter_mut().zip(&mut self.turns).zip(&self.steps) {
            grid.transform(step, opening);
            grid.integrate(opening);
            self.spectrum.copy_from_slice(opening);
            grid.integrate(&mut self.spectrum);
            grid.synthesise(&self.spectrum, turns);
        }
        let [[a, b], [c, d]] = self.turns.each_ref().map(|turns| self.gap(turns));
        let scale = 1.0 / (a * d - b * c);
        self.closing = if scale.is_finite() {
            [[scale * d, -scale * c], [-scale * b, scale * a]]
        } else {
            [[0.0; 2]; 2]
        };
    }

    /// How far a change of the angle opens the curve.
    fn gap(&self, angle: &[f64]) -> [f64; 2] {
        [-mean_of_product(&self.steps[1], angle), mean_of_product(&self.steps[0], angle)]
    }

    /// Replaces the residual r of (I − γJ)x = r by (u, ν), the right-hand side of the equation of the velocity.
    pub fn split(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        let (layout, last) = (flow.spectral_layout(), r.len() - 1);
        self.rest.fill(0.0);
        let slide = self.take_velocity(flow, r);
        flow.motion_of(&self.velocity, &mut self.made);
        self.rest[last] = r[last] - self.made[last];
        for (field, rest) in layout.spectra_mut(&mut self.rest).chunks_exact_mut(layout.modes()).enumerate() {
            for (mode, (rest, value)) in rest.iter_mut().zip(flow.frozen().spectrum(field)).enumerate() {
                *rest += Complex64::new(0.0, TAU * mode as f64 * slide) * value;
            }
            flow.grid_mut().make_real(rest);
        }
        for i in layout.field(1).start..last {
            r[i] -= self.made[i] + self.rest[i];
        }
        self.drive(flow, r);
        flow.grid_mut().transform(&self.velocity, &mut layout.spectra_mut(r)[..layout.modes()]);
        r[last] = 0.0;
    }

    /// Takes what is only carried out of the residual (·, ν), and adds what it drives, exactly.
    fn drive(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        if self.carried.is_empty() {
            return;
        }
        let layout = flow.spectral_layout();
        self.made.fill(0.0);
        for field in &self.carried {
            let range = layout.field(*field);
            self.made[range.clone()].copy_from_slice(&r[range.clone()]);
            add_scaled(&mut self.rest[range.clone()], 1.0, &self.made[range.clone()]);
            r[range].fill(0.0);
        }
        flow.implicit_velocity(&self.made);
        add_scaled(&mut self.velocity, self.gamma, flow.normal_velocity());
        for field in (1..flow.layout().fields()).filter(|field| !self.carried.contains(field)) {
            let range = layout.spectrum(field);
            flow.add_density_rate(field, self.gamma, &mut layout.spectra_mut(r)[range]);
        }
    }

    /// Replaces (v, ν) by A v + (0, ν) and what is no motion.
    pub fn complete(&mut self, flow: &mut GradientFlow, x: &mut [f64]) {
        let (layout, last) = (flow.spectral_layout(), x.len() - 1);
        flow.grid_mut().synthesise(&layout.spectra(x)[..layout.modes()], &mut self.velocity);
        flow.motion_of(&self.velocity, &mut self.made);
        x[layout.field(0)].fill(0.0);
        x[last] = 0.0;
        add_scaled(x, 1.0, &self.made);
        add_scaled(x, 1.0, &self.rest);
    }

    /// The normal velocity that makes the curvature and the length of `r`; returns the mean of the tangential one.
    fn take_velocity(&mut self, flow: &mut GradientFlow, r: &[f64]) -> f64 {
        let (modes, stretch) = (self.spectrum.len(), r[r.len() - 1] / flow.frozen().length());
        let turning = &flow.spectral_layout().spectra(r)[..modes];
        self.spectrum.copy_from_slice(turning);
        let grid = flow.grid_mut();
        grid.integrate(&mut self.spectrum);
        grid.synthesise(&self.spectrum, &mut self.angle);
        let gap = self.gap(&self.angle);
        let opened = &mut flow.spectral_layout().spectra_mut(&mut self.rest)[..modes];
        opened[0] = turning[0];
        for ((row, opening), turns) in self.closing.iter().zip(&self.openings).zip(&self.turns) {
            let factor = row[0] * gap[0] + row[1] * gap[1];
            add_scaled(cast_slice_mut(opened), factor, cast_slice(opening));
            add_scaled(&mut self.angle, -factor, turns);
        }
        let grid = flow.grid_mut();
        // δ∂_sγ = |Γ|w (δθ (−τ_y, τ_x) + δ|Γ|/|Γ| τ).
        for (component, displacement) in self.displacement.iter_mut().enumerate() {
            let sign = if component == 0 { -1.0 } else { 1.0 };
            let (across, along) = (&self.steps[1 - component], &self.steps[component]);
            for (i, value) in displacement.iter_mut().enumerate() {
                *value = sign * self.angle[i] * across[i] + stretch * along[i];
            }
            grid.transform(displacement, &mut self.spectrum);
            grid.integrate(&mut self.spectrum);
            grid.synthesise(&self.spectrum, displacement);
        }
        let ([x, y], [cosine, sine]) = (&self.displacement, &self.tangent);
        for i in 0..self.angle.len() {
            self.angle[i] = cosine[i] * x[i] + sine[i] * y[i];
            self.velocity[i] = sine[i] * x[i] - cosine[i] * y[i];
        }
        let slide = flow.frozen().mean(&self.angle);
        let mean = flow.frozen().mean(&self.velocity);
        // Of the curvature what the tangential velocity makes, ∂_s(κW), is not made by the normal one.
        multiply(&mut self.angle, flow.frozen().at_nodes(0));
        flow.grid_mut().transform(&self.angle, &mut self.spectrum);
        let opened = &flow.spectral_layout().spectra(&self.rest)[..modes];
        for (mode, (value, (turning, opened))) in
            self.spectrum.iter_mut().zip(turning.iter().zip(opened)).enumerate()
        {
            *value = turning - opened - Complex64::new(0.0, TAU * mode as f64) * *value;
        }
        flow.grid_mut().make_real(&mut self.spectrum);
        flow.velocity_of_turning(&mut self.spectrum, &mut self.velocity);
        let other = flow.frozen().mean(&self.velocity);
        shift(&mut self.velocity, mean - other);
        slide
    }
}
