//! Second derivatives as the preconditioners take them: what slopes cost on the mean, and what fields cost at the nodes.

use super::EnergySum;
use crate::geometry::vectors::mean;

/// Largest mixed cost, in geometric means of the two costs: less than one, or the costs would not be positive.
const LARGEST_CROSS: f64 = 0.99;

impl EnergySum {
    /// Coefficients of ½∫|∇_sφ|² dσ, by field.
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Whether slopes of `field` may have a cost: at some state, not at that of the linearisation.
    #[must_use]
    pub fn may_be_stiff(&self, field: usize) -> bool {
        self.stiffness[field] != 0.0 || self.terms.iter().any(|term| term.has_slope_density())
    }

    /// Mean over the nodes of ∂²e/∂φ² of `field` at the linearisation, zero if it is negative: a concave mean would make the
    /// preconditioners singular, and they may leave it out.
    #[must_use]
    pub fn convex_mean(&self, field: usize) -> f64 {
        mean(self.implicit_second(field, field)).max(0.0)
    }

    /// [`EnergySum::stiffness`] and the mean of ∂²e′/∂(∇_sφ)² at the linearisation, unless it is negative: what the
    /// preconditioners hold of the terms of (D6).
    #[must_use]
    pub fn implicit_stiffness(&self) -> &[f64] {
        &self.implicit_stiffness
    }

    /// The mean of ∂²e′/∂(∇_sφ)∂(∇_sψ) for the fields `a` and `b`, which may be the same one, as far as the costs stay positive.
    #[must_use]
    pub fn implicit_cost(&self, a: usize, b: usize) -> f64 {
        if a == b { self.implicit_stiffness[a] } else { self.cross_stiffness[a * self.layout.fields() + b] }
    }

    /// [`EnergySum::implicit_cost`] of each pair of the `F` fields.
    #[must_use]
    pub fn implicit_costs<const F: usize>(&self) -> [[f64; F]; F] {
        std::array::from_fn(|a| std::array::from_fn(|b| self.implicit_cost(a, b)))
    }

    /// ∂²e/∂φ∂ψ of the fields `a` and `b` at the linearisation, one value per node; of what (D6) takes between the nodes, the mean of
    /// the flux points beside each.
    #[must_use]
    pub fn implicit_second(&self, a: usize, b: usize) -> &[f64] {
        if self.implicit_second.is_empty() {
            return self.jet.second(a, b);
        }
        &self.implicit_second[self.layout.field(a * self.layout.fields() + b)]
    }

    fn freeze_second(&mut self) {
        let (fields, nodes) = (self.layout.fields(), self.layout.nodes());
        let mut implicit = std::mem::take(&mut self.implicit_second);
        if let Some((at_flux, _)) = self.slope_jet() {
            for (pair, out) in implicit.chunks_exact_mut(nodes).enumerate() {
                let (a, b) = (pair / fields, pair % fields);
                let (own, between) = (self.jet.second(a, b), at_flux.second(a, b));
                let mut before = between[nodes - 1];
                for ((out, own), after) in out.iter_mut().zip(own).zip(between) {
                    *out = own + 0.5 * (before + after);
                    before = *after;
                }
            }
        }
        self.implicit_second = implicit;
    }

    /// Takes the second derivatives at the state evaluated last.
    pub(super) fn freeze_stiffness(&mut self) {
        self.freeze_second();
        let fields = self.layout.fields();
        for a in 0..fields {
            self.implicit_stiffness[a] = self.stiffness[a] + self.mean_cost(a, a).max(0.0);
        }
        for a in 0..fields {
            for b in 0..a {
                let most = LARGEST_CROSS * (self.implicit_stiffness[a] * self.implicit_stiffness[b]).sqrt();
                let cost = self.mean_cost(a, b).clamp(-most, most);
                self.cross_stiffness[a * fields + b] = cost;
                self.cross_stiffness[b * fields + a] = cost;
            }
        }
    }

    /// Mean of ∂²e′/∂(∇_sφ)∂(∇_sψ), without [`EnergySum::stiffness`].
    fn mean_cost(&self, a: usize, b: usize) -> f64 {
        match (&self.moving, &self.slopes) {
            // Its jet is that of all slopes.
            (Some(moving), _) => moving.mean_cost(a, b) - if a == b { self.stiffness[a] } else { 0.0 },
            (None, Some(slopes)) => slopes.mean_cost(a, b),
            (None, None) => 0.0,
        }
    }
}
