//! Membrane density: ∫ (ρ − 1)²/(2ε) dσ, which keeps the membrane near its rest density. See `THEORY.md`, eq. (E8).

use super::{EnergyTerm, Fields, Jet, Order};

/// Penalty on stretching and compressing the membrane, whose density is ρ.
#[derive(Clone, Debug)]
pub struct Membrane {
    field: usize,
    by_epsilon: f64,
}

impl Membrane {
    /// The penalty 1/ε > 0 on density `density` (counted from 0), in energy per length; states must have that density.
    ///
    /// # Panics
    /// If ε is not positive. On states without that density, where it is evaluated.
    #[must_use]
    pub fn new(density: usize, epsilon: f64) -> Self {
        assert!(epsilon > 0.0, "a membrane of compressibility {epsilon:?}: it must be positive");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "it must be positive")]
    fn a_membrane_without_compressibility_is_refused() {
        let _ = Membrane::new(0, 0.0);
    }

    #[test]
    #[should_panic(expected = "field 3 of 2")]
    fn a_density_that_no_state_has_is_named() {
        Membrane::new(2, 0.1).add_density(Fields::new(4, &[1.0; 8]), &mut Jet::new(4, 4));
    }
}
