//! The gradient flow of a closed curve as a problem for the integrator.

mod linear_part;
mod memory;
mod solver;

use std::f64::consts::TAU;
use std::ops::Range;

use super::floors::least_mean_square;
use super::invariants::Invariants;
use crate::flow::{GradientFlow, LinearSolver, Rate};
use crate::geometry::vectors::{mean_of_product, multiply, sum};
use crate::geometry::{Closure, Crossings, Embedding, Layout};
use crate::integrator::{Finish, INTEGRALS, LinearPart, Problem};
pub use memory::MembraneMemory;
use memory::{Factorised, Placed};
use solver::Solver;

/// Index of the mean tangent angle among the integrals, of which the dissipation is the first.
pub const ANGLE: usize = 1;
/// Indices of the mean position.
pub const CENTRE: Range<usize> = 2..4;

/// A closed curve with densities under a gradient flow.
#[derive(Debug)]
pub struct Membrane {
    flow: GradientFlow,
    solver: Solver,
    closure: Closure,
    crossings: Crossings,
    turning_number: i32,
    tangential: Vec<f64>,
    closure_defect: f64,
    invariants: Invariants,
    /// Mean tangent angle where the integrals start.
    start_angle: f64,
    placed: Placed,
    candidate_angle_rate: f64,
    /// Whether the choice of the method is free, and the flow has a linear part in Fourier space.
    may_be_exponential: bool,
    /// The spectral state of the linearisation.
    linearised: Vec<f64>,
    factorised: Factorised,
}

impl Membrane {
    /// The problem of `flow` for curves of turning number `turning_number`, placed at `angle`.
    #[must_use]
    pub fn new(mut flow: GradientFlow, solver: LinearSolver, turning_number: i32, angle: f64) -> Self {
        let (nodes, size) = (flow.layout().nodes(), flow.spectral_layout().len());
        let may_be_exponential = solver == LinearSolver::Auto && linear_part::exists(&flow);
        Self {
            solver: Solver::new(solver),
            invariants: Invariants::new(&mut flow),
            closure: Closure::graded(nodes, flow.grading().cloned()),
            flow,
            crossings: Crossings::new(nodes),
            turning_number,
            tangential: vec![0.0; nodes],
            closure_defect: 0.0,
            start_angle: angle,
            placed: Placed { time: 0.0, angle, angle_rate: 0.0 },
            candidate_angle_rate: 0.0,
            may_be_exponential,
            linearised: vec![0.0; size],
            factorised: Factorised { state: vec![0.0; size], gamma: 0.0 },
        }
    }

    /// Goes on from where `before` stands, with what it keeps and the linear solver that served it.
    pub fn follow(&mut self, before: &Self) {
        self.solver.choose(before.solver.choice());
        self.invariants.set_kept_values(before.invariants.kept_values());
        self.start_angle = before.start_angle;
        self.placed = before.placed;
    }

    /// The flow.
    pub fn flow(&mut self) -> &mut GradientFlow {
        &mut self.flow
    }

    /// Shape of the state.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.flow.layout()
    }

    /// The projection onto closed curves.
    pub fn closure(&mut self) -> &mut Closure {
        &mut self.closure
    }

    /// Tangents and positions of the curve projected last, and what finds its self-crossings.
    pub fn embedding_and_crossings(&mut self) -> (&mut Embedding, &mut Crossings) {
        (self.closure.embedding(), &mut self.crossings)
    }

    /// Number of self-crossings of the spectral state `y`.
    pub fn crossings(&mut self, y: &[f64]) -> usize {
        self.follow_metric(y);
        let layout = self.flow.spectral_layout();
        let length = y[layout.length_index()];
        let embedding = self.closure.embedding();
        embedding.set_tangent_spectrum(&layout.spectra(y)[..layout.modes()], length, 0.0);
        embedding.set_position(length, [0.0; 2]);
        self.crossings.count(embedding.position())
    }

    /// Turning number of the curve.
    #[must_use]
    pub fn turning_number(&self) -> i32 {
        self.turning_number
    }

    /// Gap of the candidate finished last, before its projection.
    #[must_use]
    pub fn closure_defect(&self) -> f64 {
        self.closure_defect
    }

    /// Takes the metric of the spectral state `y`, if it is a field there, into the embedding; false if it is not positive.
    fn follow_metric(&mut self, y: &[f64]) -> bool {
        if self.flow.layout().metric().is_none() {
            return true;
        }
        self.flow.set_current(y);
        let Some(metric) = self.flow.current().moving_metric() else { return false };
        self.closure.embedding().follow(metric);
        metric.weight().iter().chain(metric.at_midpoints()).all(|weight| *weight > 0.0)
    }

    /// Rates of the integrals at the state evaluated last: dissipation, ⟨κW⟩, ⟨Vn + Wτ⟩.
    fn integral_rates(&mut self, rate: Rate) -> [f64; INTEGRALS] {
        self.flow.tangential_velocity(&mut self.tangential);
        let [tx, ty] = self.closure.embedding().tangent();
        let (at, v, w) = (self.flow.current(), self.flow.normal_velocity(), &self.tangential);
        let angle = at.mean_of_product(at.at_nodes(0), w);
        // n = (τ_y, −τ_x); the tangents hold the weights.
        let x = mean_of_product(v, ty) + mean_of_product(w, tx);
        let y = mean_of_product(w, ty) - mean_of_product(v, tx);
        let [moved_angle, moved_x, moved_y] = self.shift_of_means();
        [rate.dissipation, angle + moved_angle, x + moved_x, y + moved_y]
    }

    /// Rates of the mean angle and the mean position by the change of the weights of the nodes, ⟨(κV − ⟨κV⟩)·⟩: zero unless
    /// the metric is a field.
    fn shift_of_means(&mut self) -> [f64; 3] {
        let at = self.flow.current();
        let Some(metric) = at.moving_metric() else { return [0.0; 3] };
        self.tangential.copy_from_slice(at.at_nodes(0));
        multiply(&mut self.tangential, self.flow.normal_velocity());
        let mean = mean_of_product(metric.weight(), &self.tangential);
        for (stretch, weight) in self.tangential.iter_mut().zip(metric.weight()) {
            *stretch = weight * (*stretch - mean);
        }
        let embedding = self.closure.embedding();
        embedding.set_position(at.length(), [0.0; 2]);
        let [x, y] = embedding.position().map(|values| mean_of_product(&self.tangential, values));
        // The angle θ − 2πωs is periodic, θ is not; ⟨ẇs⟩ = −⟨ẋ⟩ with the fractions x of the arc length.
        let turning = TAU * f64::from(self.turning_number);
        let nodes = self.tangential.len() as f64;
        let periodic = |(i, angle): (usize, &f64)| angle - turning * i as f64 / nodes;
        let angles = embedding.tangent_angle().iter().enumerate().map(periodic);
        let angle = angles.zip(&self.tangential).map(|(angle, change)| angle * change).sum::<f64>() / nodes;
        let moved = self.flow.mean_antiderivative(&self.tangential);
        [angle - turning * moved, x, y]
    }
}

impl Problem for Membrane {
    fn size(&self) -> usize {
        self.flow.spectral_layout().len()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        let layout = self.flow.spectral_layout();
        let mut blocks: Vec<_> =
            (0..self.flow.layout().state_fields()).map(|field| layout.field(field)).collect();
        blocks.push(layout.length_index()..layout.len());
        blocks
    }

    fn block_floor(&self, block: usize, y: &[f64]) -> f64 {
        let length = y[self.flow.spectral_layout().length_index()];
        if block < self.flow.layout().fields() { least_mean_square(block, length) } else { f64::MIN_POSITIVE }
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.flow.spectral_rate(y, rate);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.linearised.copy_from_slice(y);
        self.flow.spectral_linearise(y);
        self.flow.frozen_rate(rate);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.flow.implicit_product(v, out);
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.factorised.state.copy_from_slice(&self.linearised);
        self.factorised.gamma = gamma;
        self.flow.linearisation_fault().is_none() && self.solver.factorise(&mut self.flow, gamma)
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.solver.apply(&mut self.flow, r);
    }

    fn weigh(&self, r: &mut [f64]) {
        self.solver.weigh(r);
    }

    fn unweigh(&self, r: &mut [f64]) {
        self.solver.unweigh(r);
    }

    fn settle(&mut self, gamma: f64, r: &mut [f64]) -> bool {
        self.solver.settle(&mut self.flow, gamma, r)
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.solver.learn(iterations, &self.flow)
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        let layout = self.flow.spectral_layout();
        let length = y[layout.length_index()];
        let Placed { time: start, angle, angle_rate } = self.placed;
        let usable = length > 0.0 && sum(y).is_finite();
        if !usable || !self.follow_metric(y) {
            return Finish::NotFinite;
        }
        // The angle at the candidate to second order; it turns the frame of the mean position only.
        let angle = angle + (time - start) * angle_rate;
        let Self { invariants, flow, closure, .. } = self;
        match invariants.restore(y, flow, closure, self.turning_number, angle) {
            Ok(gap) => self.closure_defect = gap,
            Err(_) => return Finish::NotFinite,
        }
        let rate = self.flow.spectral_dissipation(y);
        if !(rate.energy.is_finite() && rate.dissipation.is_finite()) {
            return Finish::NotFinite;
        }
        let integral_rates = self.integral_rates(rate);
        self.candidate_angle_rate = integral_rates[ANGLE];
        Finish::Good { energy: rate.energy, integral_rates }
    }

    fn finished_rate(&mut self, _: &[f64], rate: &mut [f64]) {
        self.flow.rate_at_hand(rate);
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        if !self.may_be_exponential {
            return false;
        }
        self.linearised.copy_from_slice(y);
        self.flow.spectral_linearise(y);
        linear_part::set(part, &mut self.flow)
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        Some(self.flow.energy_slope(direction))
    }

    fn is_gradient_exact(&mut self, y: &[f64]) -> Option<bool> {
        Some(!self.flow.has_wrong_gradient(y))
    }

    fn rests_with_its_energy(&self) -> bool {
        true // a gradient flow
    }

    fn forgets(&self) -> bool {
        !self.flow.carries_over_nodes()
    }

    fn undamped_frequency(&self) -> f64 {
        self.flow.sliding_frequency()
    }

    fn energy_rounding(&self, y: &[f64]) -> f64 {
        f64::EPSILON * self.flow.energy_sensitivity(y)
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        let (angle, angle_rate) = (self.start_angle + integrals[ANGLE], self.candidate_angle_rate);
        self.placed = Placed { time, angle, angle_rate };
    }
}
