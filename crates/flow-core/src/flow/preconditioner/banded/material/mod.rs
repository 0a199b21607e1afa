//! The local part of I − γJ on material points, as an equation of the normal velocity. See `THEORY.md`, eq. (O9).
//!
//! The unknowns are v, which moves the curvature by δκ = −(`Δ_s` + κ²)v, and what the nodes carry besides, ν = m/g, with
//! δρ = ν − κρv. The operator is I + γ diag(𝓑, 𝓖)·Bᵀ Hess B with B: (v, ν) ↦ (δκ, δρ), by second differences on the nodes as
//! they are: symmetric, so that its ratio to the exact one stays bounded however unequal the distances of the nodes are.

mod rows;

use super::super::fourier::mobility_symbol;
use super::local_spacing::LocalSpacing;
use super::reach::{MOST_UNEQUAL_NODES, diffuses, moves_freely};
use super::{Banded, Coefficients, Window};
use crate::flow::gradient_flow::GradientFlow;
use crate::geometry::vectors::{multiply, scale};
use crate::geometry::{Complex64, Grading};
use crate::operators::{CyclicBanded, FactorisationError};

/// Coefficients of all `F` unknowns at one node.
type Row<const F: usize> = [f64; F];

/// The band of one flow whose metric is a field, or whose nodes count as material points.
#[derive(Debug)]
pub struct MaterialPart<const F: usize, const B: usize> {
    window: Window,
    /// Whether 𝓚 makes no mean, by field.
    keeps_mean: [bool; F],
    local: LocalSpacing,
    length: f64,
    /// Whether 𝓑 is −`Δ_s`, or Id.
    is_surface_diffusion: bool,
    matrix: CyclicBanded<B>,
    /// Factors of right-hand sides and of solutions that take the symbols of the band to the right ones, by field and mode.
    rows: Vec<f64>,
    columns: Vec<f64>,
    coefficients: Coefficients<F>,
    /// Minus the tension at the nodes; zero unless 𝓑 is −`Δ_s`.
    stretching: Vec<f64>,
    /// δκ, δρ over the nodes i−1, i, i+1; their slopes over i−1 … i+2; the derivatives by them and by the stretch over i−2 … i+2; the
    /// force over i−3 … i+3.
    motion_rows: Vec<[[Row<F>; 3]; F]>,
    slope_rows: Vec<[[Row<F>; 4]; F]>,
    gradient_rows: Vec<[[Row<F>; 5]; F]>,
    stretch_rows: Vec<[Row<F>; 5]>,
    force_rows: Vec<[Row<F>; 7]>,
    /// All unknowns at the nodes.
    values: Vec<f64>,
}

impl<const F: usize, const B: usize> MaterialPart<F, B> {
    /// For `flow`.
    pub fn new(flow: &GradientFlow) -> Self {
        let nodes = flow.layout().nodes();
        let coarse = nodes.min(MOST_UNEQUAL_NODES);
        let window = Window::new(nodes, coarse);
        let grid = &window.grid;
        Self {
            keeps_mean: [false; F],
            local: LocalSpacing::new(&Grading::uniform(nodes), coarse),
            length: 1.0,
            is_surface_diffusion: diffuses(flow),
            matrix: CyclicBanded::in_blocks(coarse * F, F),
            rows: vec![1.0; F * grid.modes()],
            columns: vec![1.0; F * grid.modes()],
            coefficients: Coefficients::new(nodes, grid),
            stretching: vec![0.0; coarse],
            motion_rows: vec![[[[0.0; F]; 3]; F]; coarse],
            slope_rows: vec![[[[0.0; F]; 4]; F]; coarse],
            gradient_rows: vec![[[[0.0; F]; 5]; F]; coarse],
            stretch_rows: vec![[[0.0; F]; 5]; coarse],
            force_rows: vec![[[0.0; F]; 7]; coarse],
            values: vec![0.0; coarse * F],
            window,
        }
    }

    /// Takes the tension under surface diffusion, where long waves feel it more than they do without.
    fn set_tension(&mut self, flow: &GradientFlow) {
        if !self.is_surface_diffusion {
            return;
        }
        let stretching = flow.frozen_stretching();
        if flow.energy_terms().depends_on_positions() || stretching.len() != self.stretching.len() {
            // What the tension of the positions does, their second derivative takes away.
            self.stretching.fill(-flow.mean_tension());
        } else {
            self.stretching.copy_from_slice(stretching);
        }
    }

    /// Factors whose product is the ratio of the symbols with mean coefficients, by second differences, with 𝓑 = Id unless it is that of
    /// surface diffusion or holds the curve, to the right ones. Where the curvature follows densities that move, what a velocity makes of it
    /// must be right, k² for k² by second differences, however stiff they are; else it is shared, so that the band stays symmetric.
    fn set_factors(&mut self, flow: &GradientFlow, gamma: f64) {
        let (nodes, modes, length) =
            (self.window.grid.nodes() as f64, self.window.grid.modes(), flow.symbol_length());
        let moves_freely = moves_freely(flow);
        let follows = flow.carried_fields().count() + 1 < F;
        for field in 0..F {
            let mean = flow.energy_terms().convex_mean(field);
            let stiffness = flow.energy_terms().implicit_stiffness()[field];
            for mode in 0..self.window.common_modes() {
                let exact = flow.derivative().minus_laplacian()[mode];
                let difference = (2.0 * nodes * (std::f64::consts::PI * mode as f64 / nodes).sin()).powi(2);
                let band = match field {
                    0 if moves_freely => (difference / (length * length)).powi(2),
                    _ => mobility_symbol(flow, field, difference, length),
                };
                let symbol = |mobility: f64, laplacian: f64| {
                    1.0 + gamma * mobility * (stiffness * laplacian / (length * length) + mean)
                };
                let right = symbol(mobility_symbol(flow, field, exact, length), exact);
                let ratio = symbol(band, difference) / right;
                let column = match field {
                    _ if !follows => ratio.sqrt(),
                    0 if exact > 0.0 => difference / exact,
                    _ => 1.0,
                };
                self.columns[field * modes + mode] = column;
                self.rows[field * modes + mode] = ratio / column;
            }
        }
    }
}

impl<const F: usize, const B: usize> Banded for MaterialPart<F, B> {
    fn modes(&self) -> usize {
        self.window.modes()
    }

    fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError> {
        for (keeps, density) in self.keeps_mean.iter_mut().skip(1).zip(flow.density_mobilities()) {
            *keeps = density.conserves_mass();
        }
        self.length = flow.frozen().length();
        if let Some(metric) = flow.frozen().grading() {
            self.local.set(metric);
        }
        self.coefficients.set(flow, &mut self.window.grid);
        self.set_factors(flow, gamma);
        self.set_tension(flow);
        self.set_stencils(&flow.energy_terms().implicit_costs());
        self.fill(flow, gamma);
        self.matrix.factorise()
    }

    fn apply(&mut self, spectra: &mut [Complex64]) {
        let (nodes, modes) = (self.window.grid.nodes(), self.window.grid.modes());
        for (field, values) in self.values.chunks_exact_mut(nodes).enumerate() {
            self.window.synthesise(spectra, field, &self.rows[field * modes..], values);
            if field > 0 {
                multiply(values, &self.local.inverse);
                scale(values, 1.0 / self.length);
            }
        }
        self.matrix.solve(&mut self.values);
        for (field, values) in self.values.chunks_exact_mut(nodes).enumerate() {
            if field > 0 {
                multiply(values, &self.local.weight);
                scale(values, self.length);
            }
            // Where J makes no mean, its local part does: the mean stays as it was.
            let place = (field, self.keeps_mean[field]);
            self.window.transform(values, place, &self.columns[field * modes..], spectra);
        }
    }
}
