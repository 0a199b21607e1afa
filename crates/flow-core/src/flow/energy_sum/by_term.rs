//! The energies one by one.

use super::super::curve_fields::CurveFields;
use super::EnergySum;
use crate::energies::{Fields, Jet, TermFault};

impl EnergySum {
    /// Whether a term depends on where the nodes lie.
    #[must_use]
    pub fn depends_on_positions(&self) -> bool {
        self.shape.is_some()
    }

    /// What a term finds wrong with the state evaluated last, whose fields are `at`.
    #[must_use]
    pub fn fault(&self, at: &CurveFields) -> Option<TermFault> {
        let fields = Fields::new(self.layout.nodes(), at.pointwise());
        self.terms.iter().find_map(|term| term.fault(fields))
    }

    /// Energy of each term at a state, in the order of the terms.
    pub fn energies_by_term(&mut self, at: &CurveFields) -> Vec<f64> {
        (0..self.terms.len()).map(|term| self.energy_of(term, at)).collect()
    }

    fn energy_of(&mut self, term: usize, at: &CurveFields) -> f64 {
        let nodes = self.layout.nodes();
        let mut density = Jet::new(nodes, self.layout.fields());
        if self.terms[term].has_density() {
            self.terms[term].add_density(Fields::new(nodes, at.pointwise()), &mut density);
        }
        let of_length = self.terms[term].of_length(at.length());
        if let Some(moving) = &mut self.moving {
            let local = moving.energy_of(&mut self.terms[term], &density, of_length, at);
            let shape = self.shape.as_mut().map(|shape| shape.energy_of(&mut *self.terms[term], at));
            return local + shape.unwrap_or_default();
        }
        let mut energy = at.length() * at.mean(density.value()) + of_length.value;
        for field in 0..self.layout.fields() {
            let coefficient = self.terms[term].stiffness(field);
            if coefficient != 0.0 {
                energy += 0.5 * coefficient / at.length() * self.slope_square(at.spectrum(field));
            }
        }
        if let Some(slopes) = &mut self.slopes {
            energy += slopes.energy_of(&mut *self.terms[term], at);
        }
        if let Some(shape) = &mut self.shape {
            energy += shape.energy_of(&mut *self.terms[term], at);
        }
        energy
    }
}
