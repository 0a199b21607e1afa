//! Bending energy (b/2)∫(κ − c₀)² dσ. See `THEORY.md`, eq. (E1).

use super::{EnergyTerm, Fields, Jet, Order};

/// Bending energy with constant rigidity and preferred curvature.
#[derive(Clone, Debug)]
pub struct Bending {
    rigidity: f64,
    preferred_curvature: f64,
}

impl Bending {
    /// Rigidity b ≥ 0, in energy × length, and preferred curvature c₀, in 1/length.
    #[must_use]
    pub fn new(rigidity: f64, preferred_curvature: f64) -> Self {
        Self { rigidity, preferred_curvature }
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
        let (b, c0) = (self.rigidity, self.preferred_curvature);
        let kappa = fields.get(0);
        let order = jet.order();
        let (value, first) = jet.value_and_first_mut(0);
        for ((value, first), kappa) in value.iter_mut().zip(first).zip(kappa) {
            let excess = kappa - c0;
            *value += 0.5 * b * excess * excess;
            *first += b * excess;
        }
        if order >= Order::Hessian {
            jet.second_mut(0, 0).iter_mut().for_each(|second| *second += b);
        }
    }
}
