//! Parts that a term adds although it says that it has none: they would be left out without a word.

use super::super::curve_fields::CurveFields;
use super::super::shape_energy::ShapeEnergy;
use super::EnergySum;
use crate::energies::{Fields, Jet, Order};

/// A method of a term that adds something, while the flag that goes with it says that it does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the term `{term}` adds something in `{method}`, but its `{flag}` says that it does not: return true there"
)]
pub struct UndeclaredPart {
    /// Name of the term.
    pub term: &'static str,
    /// The method.
    pub method: &'static str,
    /// The flag.
    pub flag: &'static str,
}

impl EnergySum {
    /// The first part that a term adds at the fields `at`, or near them, and does not declare. Allocates.
    #[cold]
    pub fn undeclared(&mut self, at: &CurveFields) -> Option<UndeclaredPart> {
        let nodes = self.layout.nodes();
        let at_nodes = Fields::new(nodes, at.pointwise());
        let with_slopes = with_slopes(at_nodes);
        let with_slopes = Fields::new(nodes, &with_slopes);
        let mut shape = ShapeEnergy::new(self.layout, &self.grid, &self.derivative);
        let mut found = None;
        for term in &mut self.terms {
            let name = term.name();
            let undeclared = |method, flag| Some(UndeclaredPart { term: name, method, flag });
            if !term.has_density() && adds(at_nodes, |fields, jet| term.add_density(fields, jet)) {
                found = found.or(undeclared("add_density", "has_density"));
            }
            if !term.has_slope_density()
                && adds(with_slopes, |fields, jet| term.add_slope_density(fields, jet))
            {
                found = found.or(undeclared("add_slope_density", "has_slope_density"));
            }
            if !term.has_shape_energy() && shape.is_changed_by(&mut **term, at) {
                found = found.or(undeclared("add_shape_energy", "has_shape_energy"));
            }
        }
        found
    }
}

/// Whether `add` leaves anything in a jet of the `fields`; NaN is something.
fn adds(fields: Fields<'_>, add: impl FnOnce(Fields<'_>, &mut Jet)) -> bool {
    let mut jet = Jet::new(fields.nodes(), fields.count());
    jet.clear(Order::Hessian);
    add(fields, &mut jet);
    !jet.is_zero()
}

/// The fields, and then slopes of them, which are those of no state: a circle has none, and terms of slopes are zero there.
fn with_slopes(fields: Fields<'_>) -> Vec<f64> {
    let all = (0..fields.count()).flat_map(|field| fields.get(field));
    let slopes = all.clone().enumerate().map(|(i, value)| (1.0 + value.abs()) * (1.0 + i as f64).cos());
    all.copied().chain(slopes).collect()
}
