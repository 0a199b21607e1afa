//! What the energies of positions ask for, and what holds the area against them.

use super::{EnergySum, ShapeEnergy};
use crate::energies::Order;
use crate::flow::curve_fields::CurveFields;
use crate::flow::intrinsic_gradient::IntrinsicGradient;

impl EnergySum {
    /// Whether a term depends on where the nodes lie.
    #[must_use]
    pub fn depends_on_positions(&self) -> bool {
        self.shape.is_some()
    }

    /// Whether no other terms make the energy: nothing damps short waves then.
    #[must_use]
    pub fn is_of_positions_alone(&self) -> bool {
        self.terms.iter().all(|term| term.has_shape_energy())
    }

    /// Largest distance of nodes on which the parts that depend on positions are off by the part `error` at most.
    #[must_use]
    pub fn largest_spacing(&self, length: f64, error: f64) -> f64 {
        self.terms.iter().map(|term| term.largest_spacing(length, error)).fold(f64::INFINITY, f64::min)
    }

    /// Takes what the area costs for what it does at `kept_area` from now on, a constant that counts in energies, or no longer.
    pub fn set_kept_area(&mut self, kept_area: Option<f64>) {
        if let Some(shape) = &mut self.shape {
            shape.set_kept_area(kept_area);
        }
    }

    /// The area at which what it costs is a constant; none if it costs nothing.
    #[must_use]
    pub fn kept_area(&self) -> Option<f64> {
        let costs = |area: &f64| self.terms.iter().any(|term| term.cost_of_area(*area).is_some());
        self.shape.as_ref().and_then(ShapeEnergy::kept_area).filter(costs)
    }

    /// Whether something holds the length: a penalty on it, or an energy of positions.
    #[must_use]
    pub fn holds_length(&self, length: f64) -> bool {
        self.shape.is_some() || self.of_length(length).second != 0.0
    }

    /// Sum of the derivatives by the positions in the gradient evaluated last, as a part of their size: 0 but for rounding, unless a
    /// term depends on the origin.
    #[must_use]
    pub fn net_force(&self) -> f64 {
        self.shape.as_ref().map_or(0.0, ShapeEnergy::net_force)
    }

    /// Adds to `gradient` what the terms that depend on positions add; returns their energy.
    pub(super) fn add_shape_gradient(
        &mut self,
        at: &CurveFields,
        order: Order,
        gradient: &mut IntrinsicGradient,
    ) -> f64 {
        let Some(shape) = &mut self.shape else { return 0.0 };
        if order >= Order::Hessian {
            self.without_positions.copy_from(gradient);
        }
        shape.add_gradient(&mut self.terms, at, order, gradient)
    }

    /// The gradient at the linearisation without the terms that depend on positions; empty if there are none.
    #[must_use]
    pub fn gradient_without_positions(&self) -> &IntrinsicGradient {
        &self.without_positions
    }

    /// Tension at the linearisation of the terms that depend on positions and are line energies.
    #[must_use]
    pub fn line_tension(&self) -> f64 {
        self.shape.as_ref().map_or(0.0, ShapeEnergy::line_tension)
    }

    /// Makes the second derivative at the linearisation that of 𝓕 + `multiplier` × area, and `gradient`, that of 𝓕 there, its gradient.
    pub fn hold_area(&mut self, multiplier: f64, gradient: &mut IntrinsicGradient) {
        if let Some(shape) = &mut self.shape {
            shape.hold_area(multiplier, gradient);
        }
    }
}
