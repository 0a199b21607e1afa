//! Bending energy (b/2)∫κ² dσ. See `THEORY.md`, eq. (E1).

use super::{EnergyTerm, Fields, Jet, Order};

/// Bending energy with constant rigidity.
#[derive(Clone, Debug)]
pub struct Bending {
    rigidity: f64,
}

impl Bending {
    /// Rigidity b ≥ 0, in energy × length.
    #[must_use]
    pub fn new(rigidity: f64) -> Self {
        Self { rigidity }
    }
}

impl EnergyTerm for Bending {
    fn name(&self) -> &'static str {
        "bending"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let b = self.rigidity;
        let kappa = fields.get(0);
        let order = jet.order();
        let (value, first) = jet.value_and_first_mut(0);
        for ((value, first), kappa) in value.iter_mut().zip(first).zip(kappa) {
            *value += 0.5 * b * kappa * kappa;
            *first += b * kappa;
        }
        if order >= Order::Hessian {
            jet.second_mut(0, 0).iter_mut().for_each(|second| *second += b);
        }
    }
}
