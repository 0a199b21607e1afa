//! The local part of I − γJ with variable coefficients, by the compact fourth-order Laplacian on a grid of its own,
//! corrected on both sides by the root of the ratio of the symbols.
//!
//! The ratio of the constant-coefficient symbols takes out what the differences miss at high modes. Modes that a coarser
//! grid does not hold are left to the Fourier symbol. The tangential (non-local) part is of order 3 against 6
//! and left to the Krylov iteration. See `THEORY.md`, eq. (O2).

mod rows;

use rows::Stencils;

use super::super::fourier::{diagonal_symbol, mobility_symbol};
use super::compact_laplacian::{mass_symbol, symbol_of_mass};
use super::local_spacing::LocalSpacing;
use super::reach::{MOST_UNEQUAL_NODES, diffuses, most_at_first, moves_freely};
use super::{Banded, Coefficients, Window};
use crate::flow::gradient_flow::GradientFlow;
use crate::geometry::Complex64;
use crate::geometry::vectors::multiply;
use crate::operators::{CyclicBanded, FactorisationError};

/// The band of one flow whose metric is no field.
#[derive(Debug)]
pub struct LocalPart<const F: usize, const B: usize> {
    window: Window,
    /// Whether 𝓚 makes no mean, by field.
    keeps_mean: [bool; F],
    local: Option<LocalSpacing>,
    /// Whether V is −`Δ_s` f, or f.
    is_surface_diffusion: bool,
    /// Whether the energy density counts as convex.
    is_convex: bool,
    matrix: CyclicBanded<B>,
    /// Symbol of A by mode.
    mass: Vec<f64>,
    /// Factors on the right-hand sides and on the solutions, by field and mode: powers of A, and the root of
    /// the ratio of the symbols; where slopes of densities drive the curvature, the ratio on the right-hand sides.
    before: Vec<f64>,
    after: Vec<f64>,
    coefficients: Coefficients<F>,
    stencils: Stencils<F>,
    /// All fields at the nodes.
    values: Vec<f64>,
}

impl<const F: usize, const B: usize> LocalPart<F, B> {
    /// For `flow`, on at most `most_nodes` nodes if they are equidistant.
    pub fn new(flow: &GradientFlow, most_nodes: usize) -> Self {
        let (nodes, grading) = (flow.layout().nodes(), flow.grading());
        let is_surface_diffusion = diffuses(flow);
        let most = if grading.is_some() { MOST_UNEQUAL_NODES } else { most_nodes };
        let coarse = nodes.min(most);
        let window = Window::new(nodes, coarse);
        let grid = &window.grid;
        let matrix = CyclicBanded::in_blocks(coarse * F, F);
        Self {
            keeps_mean: [true; F],
            local: grading.map(|grading| LocalSpacing::new(grading, coarse)),
            is_surface_diffusion,
            is_convex: false,
            stencils: Stencils::new(matrix.places() / F, is_surface_diffusion),
            matrix,
            mass: (0..grid.modes()).map(|mode| mass_symbol(mode, coarse)).collect(),
            before: vec![1.0; F * grid.modes()],
            after: vec![1.0; F * grid.modes()],
            coefficients: Coefficients::new(nodes, grid),
            values: vec![0.0; coarse * F],
            window,
        }
    }

    /// That which counts the energy density as convex.
    pub fn convex(flow: &GradientFlow) -> Self {
        Self { is_convex: true, ..Self::new(flow, most_at_first(flow)) }
    }

    /// Symbols of the diagonal block of `field` with mean coefficients: by second differences with the normal mobility
    /// left out unless it is surface diffusion or holds the curve, as in the band, and the right one.
    fn diagonal_symbols(
        flow: &GradientFlow,
        field: usize,
        mean: f64,
        gamma: f64,
        [difference, exact]: [f64; 2],
    ) -> [f64; 2] {
        let length = flow.symbol_length();
        let square = difference / (length * length);
        let band = if field == 0 && moves_freely(flow) {
            square * square
        } else {
            mobility_symbol(flow, field, difference, length)
        };
        let stiffness = flow.energy_terms().implicit_stiffness()[field];
        let band = 1.0 + gamma * band * (stiffness * square + mean);
        [band, 1.0 + gamma * diagonal_symbol(flow, field, exact, mean)]
    }

    fn set_correction(&mut self, flow: &GradientFlow, gamma: f64) {
        let (coarse, modes) = (self.window.grid.nodes(), self.window.grid.modes());
        // What slopes of a density do to the curvature is of the order of the curvature's row.
        let by_rows = flow.energy_terms().implicit_costs::<F>()[0][1..].iter().any(|cost| *cost != 0.0);
        for field in 0..F {
            let mean = flow.energy_terms().convex_mean(field);
            for mode in 0..self.window.common_modes() {
                let exact = flow.derivative().minus_laplacian()[mode];
                let mass = self.mass[mode];
                let difference = symbol_of_mass(mass, coarse);
                let [band, right] = Self::diagonal_symbols(flow, field, mean, gamma, [difference, exact]);
                let mut power = if field == 0 { mass * mass } else { mass };
                if self.is_surface_diffusion {
                    power *= mass;
                }
                let ratio = band / right;
                let [before, after] = if by_rows { [ratio, 1.0] } else { [ratio.sqrt(); 2] };
                self.before[field * modes + mode] = power * before;
                self.after[field * modes + mode] = mass * after;
            }
        }
    }
}

impl<const F: usize, const B: usize> Banded for LocalPart<F, B> {
    fn modes(&self) -> usize {
        self.window.modes()
    }

    fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError> {
        for (keeps, density) in self.keeps_mean.iter_mut().skip(1).zip(flow.density_mobilities()) {
            *keeps = density.conserves_mass();
        }
        self.coefficients.set(flow, &mut self.window.grid);
        if self.is_convex {
            self.coefficients.make_convex();
        }
        self.set_correction(flow, gamma);
        let scale = (self.window.grid.nodes() as f64 / flow.frozen().length()).powi(2);
        self.fill(flow, gamma, scale);
        self.matrix.factorise()
    }

    fn apply(&mut self, spectra: &mut [Complex64]) {
        let (nodes, modes) = (self.window.grid.nodes(), self.window.grid.modes());
        for (field, values) in self.values.chunks_exact_mut(nodes).enumerate() {
            self.window.synthesise(spectra, field, &self.before[field * modes..], values);
            if let Some(local) = &self.local {
                multiply(values, &local.inverse);
            }
        }
        self.matrix.solve(&mut self.values);
        for (field, values) in self.values.chunks_exact_mut(nodes).enumerate() {
            if let Some(local) = &self.local {
                multiply(values, &local.weight);
            }
            // Where J makes no mean, its local part does: the mean stays as it was.
            let place = (field, self.keeps_mean[field]);
            self.window.transform(values, place, &self.after[field * modes..], spectra);
        }
    }
}
