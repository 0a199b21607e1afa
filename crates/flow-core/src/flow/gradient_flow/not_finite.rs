//! What is wrong with the terms at the state evaluated last: values that are not finite, parts that they do not declare.

use super::GradientFlow;
use crate::flow::energy_sum::{NotFinite, UndeclaredPart};

impl GradientFlow {
    /// Whether the pointwise second derivatives of the energy are finite there: no implicit step can be taken from it otherwise.
    pub fn has_finite_second_derivatives(&mut self) -> bool {
        self.linearised = false; // products would be those of two states
        self.energy.has_finite_second_derivatives(&self.current.fields)
    }

    /// The value of a term that is not finite there, or too large to be squared, if there is one.
    pub fn not_finite(&mut self) -> Option<NotFinite> {
        self.linearised = false;
        self.energy.not_finite(&self.current.fields)
    }

    /// The first part that a term adds there although it says that it has none: the flow leaves it out.
    pub fn undeclared_part(&mut self) -> Option<UndeclaredPart> {
        self.energy.undeclared(&self.current.fields)
    }
}
