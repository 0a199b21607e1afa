//! The formula of a step: the prediction, and what corrections change of it.

use super::orders::MOST_MOMENTS;
use super::polynomials::{Coefficients, of_last_point, of_new_value};
use super::sums::{self, Correction};
use super::{Exponential, MOST_CHANGES};
use crate::integrator::history::{MOST_POINTS, lagrange};

/// What one value of N misses, all along the step.
const CONSTANT: Correction = {
    let [mut weights, mut polynomial] = [[0.0; MOST_MOMENTS]; 2];
    (weights[0], polynomial[0]) = (1.0, 1.0);
    Correction { points: 1, weights, terms: 1, polynomial }
};

/// Weights of the polynomial through `nodes` at u = 1.
pub(super) fn weights_at_end(nodes: &[f64]) -> [f64; MOST_MOMENTS] {
    let mut weights = [0.0; MOST_MOMENTS];
    weights[..nodes.len()].copy_from_slice(&lagrange(1.0, nodes).value[..nodes.len()]);
    weights
}

impl Exponential {
    pub(super) fn predict(&mut self) {
        let points = self.pace.order;
        let basis = self.substitution.lagrange_basis(&self.nodes[..points]);
        let terms = self.substitution.terms(points);
        let Self { predicted, moments, bases, rests, pace, .. } = self;
        let basis = (&basis[..points], terms);
        sums::extrapolate(pace.step, basis, moments.blocks(), (&bases[0], rests), predicted);
        self.part.from_eigenbasis(predicted);
    }

    /// The candidate by the last `order` values of N and the one at the prediction; the differences that tell its error.
    pub(super) fn correct(&mut self) {
        let order = self.pace.order;
        let (watched, known) = (self.watched(), self.states.len());
        let watched = || watched.into_iter().filter(|points| (1..=known).contains(points));
        let mut corrections = [self.correction(order, of_new_value); MOST_CHANGES];
        let mut count = 1;
        for points in watched() {
            corrections[count] = self.correction(points, of_last_point);
            count += 1;
        }
        self.change(&corrections[..count]);
        let Self { candidate, predicted, changes, .. } = self;
        for ((y, predicted), change) in candidate.iter_mut().zip(&**predicted).zip(&*changes[0]) {
            *y = *predicted + change;
        }
        self.differences = [None; MOST_POINTS + 1];
        for (points, change) in watched().zip(&self.changes[1..]) {
            self.differences[points] = Some(self.norm.norm(change));
        }
        self.compare_clocks(corrections[0]);
    }

    /// A change by what the last `points` values of N miss at the prediction, along the `polynomial` for their θ.
    fn correction(&self, points: usize, polynomial: fn(&[f64]) -> Coefficients) -> Correction {
        let nodes = &self.nodes[..points];
        let (weights, mut polynomial) = (weights_at_end(nodes), polynomial(nodes));
        let terms = self.substitution.terms(points + 1);
        self.substitution.take_to_theta(&mut polynomial);
        Correction { points, weights, terms, polynomial }
    }

    /// `changes` by the `corrections`, in the original basis.
    pub(super) fn change(&mut self, corrections: &[Correction]) {
        let Self { part, moments, predicted_rest, rests, changes, pace, .. } = self;
        sums::correct(pace.step, corrections, moments.blocks(), (predicted_rest, rests), changes);
        changes[..corrections.len()].iter_mut().for_each(|change| part.from_eigenbasis(change));
    }

    /// What a second correction would change of the candidate, into the first of `changes`.
    pub(super) fn correct_again(&mut self) {
        let Self { part, moments, predicted_rest, candidate_rest, changes, pace, .. } = self;
        let past = std::slice::from_ref(predicted_rest);
        sums::correct(pace.step, &[CONSTANT], moments.blocks(), (candidate_rest, past), changes);
        part.from_eigenbasis(&mut changes[0]);
    }
}
