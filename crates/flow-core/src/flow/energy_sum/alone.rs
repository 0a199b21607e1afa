//! Each term alone: its energy, and what it costs, by evaluations with it alone less evaluations with none.

use std::mem;
use std::time::Instant;

use super::super::curve_fields::CurveFields;
use super::EnergySum;
use crate::energies::EnergyTerm;
use crate::flow::IntrinsicGradient;

/// Seconds that evaluations of the energy take with some terms.
#[derive(Clone, Copy, Debug)]
pub struct TermCost {
    /// The gradient.
    pub gradient: f64,
    /// The gradient and the second derivative.
    pub linearisation: f64,
    /// A product with the second derivative.
    pub product: f64,
}

impl TermCost {
    /// Before any measurement.
    pub const LARGEST: Self =
        Self { gradient: f64::INFINITY, linearisation: f64::INFINITY, product: f64::INFINITY };

    /// The smaller of each.
    fn least(self, other: Self) -> Self {
        Self {
            gradient: self.gradient.min(other.gradient),
            linearisation: self.linearisation.min(other.linearisation),
            product: self.product.min(other.product),
        }
    }

    /// Over `base`; a term that costs nothing may seem to cost less.
    #[must_use]
    pub fn over(self, base: Self) -> Self {
        Self {
            gradient: (self.gradient - base.gradient).max(0.0),
            linearisation: (self.linearisation - base.linearisation).max(0.0),
            product: (self.product - base.product).max(0.0),
        }
    }
}

impl EnergySum {
    /// Energy of each term at a state, in the order of the terms; the linearisation stays.
    pub fn energies_by_term(&mut self, at: &CurveFields) -> Vec<f64> {
        let mut gradient = self.room();
        let mut energies = Vec::with_capacity(self.terms.len());
        self.each_alone(|alone| energies.push(alone.gradient(at, &mut gradient)));
        energies
    }

    /// Lowers `costs`, of no term and of each term alone, to what a round of evaluations at the state `at`, with `motion` as a
    /// motion of it, takes. Overwrites `gradient` and the linearisation.
    pub fn measure_terms(
        &mut self,
        at: &CurveFields,
        motion: &[f64],
        gradient: &mut IntrinsicGradient,
        costs: &mut [TermCost],
    ) {
        let terms = mem::take(&mut self.terms);
        let (slopes, shape) = (self.slopes.take(), self.shape.take());
        let stiffness = mem::replace(&mut self.stiffness, vec![0.0; self.layout.fields()]);
        costs[0] = costs[0].least(self.measure(at, motion, gradient));
        (self.terms, self.slopes, self.shape, self.stiffness) = (terms, slopes, shape, stiffness);
        let mut costs = costs[1..].iter_mut();
        self.each_alone(|alone| {
            if let Some(cost) = costs.next() {
                *cost = cost.least(alone.measure(at, motion, gradient));
            }
        });
    }

    /// Calls `visit` with the sum of each term alone, in their order, with the machinery that this term needs and no other.
    pub(in crate::flow) fn each_alone(&mut self, mut visit: impl FnMut(&mut Self)) {
        let terms = mem::take(&mut self.terms);
        let stiffness = self.stiffness.clone();
        let mut back: Vec<Box<dyn EnergyTerm>> = Vec::with_capacity(terms.len());
        for term in terms {
            for (field, stiffness) in self.stiffness.iter_mut().enumerate() {
                *stiffness = term.stiffness(field);
            }
            let slopes = if term.has_slope_density() { None } else { self.slopes.take() };
            let shape = if term.has_shape_energy() { None } else { self.shape.take() };
            self.terms.push(term);
            visit(self);
            back.append(&mut self.terms);
            self.slopes = self.slopes.take().or(slopes);
            self.shape = self.shape.take().or(shape);
        }
        (self.terms, self.stiffness) = (back, stiffness);
    }

    fn measure(&mut self, at: &CurveFields, motion: &[f64], gradient: &mut IntrinsicGradient) -> TermCost {
        let mut clock = Instant::now();
        let mut lap = || mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
        self.gradient(at, gradient);
        let first = lap();
        self.linearise(at, gradient);
        let second = lap();
        self.hessian_product(at, motion, gradient);
        TermCost { gradient: first, linearisation: second, product: lap() }
    }
}
