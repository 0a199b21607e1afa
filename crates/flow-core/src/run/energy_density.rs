//! Energy per length along the curve, of the terms that are local. See `THEORY.md`, eq. (D3).

use crate::energies::{EnergyTerm, Fields, Jet};
use crate::flow::CurveFields;
use crate::geometry::vectors::multiply;
use crate::geometry::{Complex64, Layout, PeriodicGrid};
use crate::operators::{Derivative, DerivativeFamily};

/// e(κ, ρ) + Σ (c/2)|∇_sφ|² + e′(κ, ρ, ∇_sκ, ∇_sρ) at the nodes; slopes are those of the trigonometric interpolant.
#[derive(Debug)]
pub struct EnergyDensity {
    terms: Vec<Box<dyn EnergyTerm>>,
    layout: Layout,
    grid: PeriodicGrid,
    derivative: Derivative,
    /// The fields, then their slopes.
    fields: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl EnergyDensity {
    /// The density of `terms` on states of `layout`.
    #[must_use]
    pub fn new(terms: Vec<Box<dyn EnergyTerm>>, layout: Layout) -> Self {
        let grid = PeriodicGrid::new(layout.nodes());
        let (nodes, fields) = (layout.nodes(), layout.fields());
        Self {
            terms,
            layout,
            derivative: Derivative::new(DerivativeFamily::Fourier, &grid),
            fields: vec![0.0; 2 * fields * nodes],
            spectrum: vec![Complex64::default(); grid.modes()],
            grid,
        }
    }

    /// The density at the fields `at`, one value per node.
    pub fn at(&mut self, at: &CurveFields) -> Vec<f64> {
        self.fill(at);
        let (nodes, count) = (self.layout.nodes(), self.layout.fields());
        let all = Fields::new(nodes, &self.fields);
        let plain = Fields::new(nodes, &self.fields[..count * nodes]);
        let (mut jet, mut slope_jet) = (Jet::new(nodes, count), Jet::new(nodes, 2 * count));
        let mut squares = vec![0.0; nodes];
        for term in &mut self.terms {
            if term.has_density() {
                term.add_density(plain, &mut jet);
            }
            if term.has_slope_density() {
                term.add_slope_density(all, &mut slope_jet);
            }
            for field in 0..count {
                let half = 0.5 * term.stiffness(field);
                for (square, slope) in squares.iter_mut().zip(all.get(count + field)) {
                    *square += half * slope * slope;
                }
            }
        }
        let local = jet.value().iter().zip(slope_jet.value());
        local.zip(squares).map(|((e, slope), square)| e + slope + square).collect()
    }

    fn fill(&mut self, at: &CurveFields) {
        let count = self.layout.fields();
        for field in 0..count {
            self.fields[self.layout.field(field)].copy_from_slice(at.at_nodes(field));
            let symbols = self.derivative.to_flux();
            for ((slope, phi), symbol) in self.spectrum.iter_mut().zip(at.spectrum(field)).zip(symbols) {
                *slope = phi * symbol / at.length();
            }
            let slopes = &mut self.fields[self.layout.field(count + field)];
            self.grid.synthesise(&self.spectrum, slopes);
            if let Some(grading) = at.grading() {
                multiply(slopes, grading.inverse());
            }
        }
    }
}
