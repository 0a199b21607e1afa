//! The fields and the second derivatives of the energy density on the grid of the band.

use crate::flow::gradient_flow::GradientFlow;
use crate::geometry::{Complex64, PeriodicGrid};

/// Values of `F` fields and of the second derivatives by them at the coarse nodes, fields first.
#[derive(Debug)]
pub struct Coefficients<const F: usize> {
    nodes: usize,
    values: Vec<f64>,
    /// The nodes of the flow, unless they are those of the band.
    fine_grid: Option<PeriodicGrid>,
    fine_spectrum: Vec<Complex64>,
    spectrum: Vec<Complex64>,
}

impl<const F: usize> Coefficients<F> {
    /// For a flow on `nodes` nodes and a band on the nodes of `grid`.
    pub fn new(nodes: usize, grid: &PeriodicGrid) -> Self {
        let coarse = grid.nodes();
        Self {
            nodes: coarse,
            values: vec![0.0; (F + F * (F + 1) / 2) * coarse],
            fine_grid: (nodes != coarse).then(|| PeriodicGrid::new(nodes)),
            fine_spectrum: vec![Complex64::default(); nodes / 2 + 1],
            spectrum: vec![Complex64::default(); grid.modes()],
        }
    }

    /// Takes the values at the frozen state of `flow`.
    pub fn set(&mut self, flow: &mut GradientFlow, grid: &mut PeriodicGrid) {
        let low = grid.modes().min(self.fine_spectrum.len());
        let nodes = self.nodes;
        for field in 0..F {
            self.spectrum.fill(Complex64::default());
            self.spectrum[..low].copy_from_slice(&flow.frozen().spectrum(field)[..low]);
            grid.synthesise(&self.spectrum, &mut self.values[field * nodes..(field + 1) * nodes]);
        }
        let mut block = F;
        for a in 0..F {
            for b in 0..=a {
                let range = block * nodes..(block + 1) * nodes;
                let second = flow.energy_terms().implicit_second(a, b);
                if let Some(fine) = &mut self.fine_grid {
                    fine.transform(second, &mut self.fine_spectrum);
                    self.spectrum.fill(Complex64::default());
                    self.spectrum[..low].copy_from_slice(&self.fine_spectrum[..low]);
                    grid.synthesise(&self.spectrum, &mut self.values[range]);
                } else {
                    self.values[range].copy_from_slice(second);
                }
                block += 1;
            }
        }
    }

    /// Takes what is concave in a single field for flat.
    pub fn make_convex(&mut self) {
        for second in &mut self.values[F * self.nodes..] {
            *second = second.max(0.0);
        }
    }

    /// Field `f` at node `i`.
    pub fn field(&self, i: usize, f: usize) -> f64 {
        self.values[f * self.nodes + i]
    }

    /// Second derivative by the fields `a` and `b` at node `i`.
    pub fn second(&self, i: usize, a: usize, b: usize) -> f64 {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        self.values[(F + high * (high + 1) / 2 + low) * self.nodes + i]
    }
}
