//! The sum of the local densities.

use super::super::curve_fields::CurveFields;
use super::EnergySum;
use crate::energies::{Fields, Order};

impl EnergySum {
    /// The densities of all terms at the nodes, into the jet.
    pub(super) fn set_density(&mut self, at: &CurveFields, order: Order) {
        let fields = Fields::new(self.layout.nodes(), at.pointwise());
        let mut terms = self.terms.iter_mut().filter(|term| term.has_density());
        self.jet.set_order(order);
        match terms.next() {
            Some(first) => first.set_density(fields, &mut self.jet),
            None => self.jet.clear(order),
        }
        terms.for_each(|term| term.add_density(fields, &mut self.jet));
    }
}
