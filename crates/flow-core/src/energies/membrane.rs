//! Membrane density: ∫ (ρ − 1)²/(2ε) dσ, which keeps the membrane near its rest density. See `THEORY.md`, eq. (E8).

use super::{EnergyTerm, Fields, Jet, Order};

/// Penalty on stretching and compressing the membrane, whose density is ρ.
#[derive(Clone, Debug)]
pub struct Membrane {
    field: usize,
    by_epsilon: f64,
}

impl Membrane {
    /// The penalty 1/ε > 0 on density `density` (counted from 0), in energy per length.
    #[must_use]
    pub fn new(density: usize, epsilon: f64) -> Self {
        Self { field: 1 + density, by_epsilon: 1.0 / epsilon }
    }
}

impl EnergyTerm for Membrane {
    fn name(&self) -> &'static str {
        "membrane"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let (order, by_epsilon) = (jet.order(), self.by_epsilon);
        let (value, first) = jet.value_and_first_mut(self.field);
        for ((value, first), rho) in value.iter_mut().zip(first).zip(fields.get(self.field)) {
            let excess = rho - 1.0;
            *value += 0.5 * by_epsilon * excess * excess;
            *first += by_epsilon * excess;
        }
        if order >= Order::Hessian {
            jet.second_mut(self.field, self.field).iter_mut().for_each(|second| *second += by_epsilon);
        }
    }
}
