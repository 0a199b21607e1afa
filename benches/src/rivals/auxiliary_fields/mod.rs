//! I − γJ solved with V, W and the adjoint of W as further fields of a cyclic band, each of whose rows is of second order.
//!
//! The band has central differences of order 2: it is the exact operator of that family, and a preconditioner for the
//! others, whose symbols are put right on both sides as in the core's banded one.

mod band;
mod border;
mod correction;
mod places;
mod rows;

use std::ops::Range;

use flow_core::flow::GradientFlow;
use flow_core::geometry::{PeriodicGrid, SpectralLayout};
use flow_core::integrator::{Finish, INTEGRALS, Problem};

use super::Shared;
use band::Band;
use border::{BORDER, Border};
use correction::Correction;
use places::Places;

/// Energy terms that depend on neither slopes nor the places of the nodes, beyond their stiffness.
const POINTWISE: [&str; 6] = ["agents", "bending", "length", "membrane", "packing", "regularization"];

/// A problem whose systems are preconditioned by the bordered band.
#[derive(Debug)]
pub struct AuxiliaryFields {
    problem: Shared,
    grid: PeriodicGrid,
    layout: SpectralLayout,
    places: Places,
    band: Box<dyn Band>,
    border: Border,
    correction: Correction,
    nodal: Vec<f64>,
    unknowns: Vec<f64>,
}

impl AuxiliaryFields {
    /// The problem `problem`, whose own preconditioner is prepared as well, for its weights of residuals: let it be the
    /// cheapest, `fourier`.
    ///
    /// # Panics
    /// If the flow is not one that the band holds: uniform nodes, 𝓑 = Id, at most two densities, and energies without
    /// slopes or positions. The cases and tests are chosen so.
    #[must_use]
    pub fn new(problem: Shared) -> Self {
        let (layout, nodal_layout) = {
            let mut membrane = problem.0.borrow_mut();
            let flow = membrane.flow();
            assert!(flow.grading().is_none(), "the band is for uniform nodes");
            assert!(flow.normal_mobility().is_identity(), "the band has 𝓑 = Id");
            for name in flow.energy_terms().names() {
                assert!(POINTWISE.contains(&name), "the energy `{name}` is not in the band");
            }
            (flow.spectral_layout(), flow.layout())
        };
        let places = Places { nodes: nodal_layout.nodes(), fields: nodal_layout.fields() };
        Self {
            problem,
            grid: PeriodicGrid::new(places.nodes),
            layout,
            band: band::build(places),
            border: Border::new(places),
            correction: Correction::new(places.fields, layout.modes()),
            nodal: vec![0.0; nodal_layout.len()],
            unknowns: vec![0.0; places.unknowns()],
            places,
        }
    }

    fn fill(&mut self, flow: &GradientFlow, gamma: f64) -> bool {
        rows::fill(flow, self.places, gamma, &mut *self.band);
        self.band.factorise() && self.border.set(flow, self.places, gamma, &mut *self.band)
    }
}

impl Problem for AuxiliaryFields {
    fn factorise(&mut self, gamma: f64) -> bool {
        if !self.problem.factorise(gamma) {
            return false;
        }
        let shared = self.problem.clone();
        let mut membrane = shared.0.borrow_mut();
        let flow = membrane.flow();
        self.correction.set(flow, gamma);
        self.fill(flow, gamma)
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.correction.apply(self.layout.spectra_mut(r));
        let (places, last) = (self.places, self.layout.length_index());
        let length = self.border.length();
        self.unknowns.fill(0.0);
        for (field, spectrum) in self.layout.spectra(r).chunks_exact(self.layout.modes()).enumerate() {
            let values = &mut self.nodal[..places.nodes];
            self.grid.synthesise(spectrum, values);
            for (node, value) in values.iter().enumerate() {
                self.unknowns[places.motion(field, node)] = value / length;
            }
        }
        self.band.solve(&mut self.unknowns);
        let mut sides = [0.0; BORDER];
        sides[border::LENGTH_ROW] = r[last] / length;
        r[last] = length * self.border.complete(&sides, &mut self.unknowns);
        for (field, spectrum) in self.layout.spectra_mut(r).chunks_exact_mut(self.grid.modes()).enumerate() {
            let values = &mut self.nodal[..places.nodes];
            for (node, value) in values.iter_mut().enumerate() {
                *value = length * self.unknowns[places.motion(field, node)];
            }
            self.grid.transform(values, spectrum);
        }
        self.grid.make_real(self.layout.spectra_mut(r));
        self.correction.apply(self.layout.spectra_mut(r));
    }

    fn size(&self) -> usize {
        self.problem.size()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        self.problem.blocks()
    }

    fn block_floor(&self, block: usize, y: &[f64]) -> f64 {
        self.problem.block_floor(block, y)
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.problem.rate(y, rate);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.problem.linearise(y, rate);
    }

    fn weigh(&self, r: &mut [f64]) {
        self.problem.weigh(r);
    }

    fn unweigh(&self, r: &mut [f64]) {
        self.problem.unweigh(r);
    }

    fn settle(&mut self, gamma: f64, r: &mut [f64]) -> bool {
        self.problem.settle(gamma, r)
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.problem.jacobian_product(v, out);
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.problem.krylov_feedback(iterations)
    }

    fn energy_rounding(&self, y: &[f64]) -> f64 {
        self.problem.energy_rounding(y)
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        self.problem.energy_slope(direction)
    }

    fn finished_rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.problem.finished_rate(y, rate);
    }

    fn rests_with_its_energy(&self) -> bool {
        self.problem.rests_with_its_energy()
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        self.problem.finish(time, y)
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.problem.accepted(time, integrals);
    }
}
