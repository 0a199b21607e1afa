//! Length: tension σ|Γ| or penalty (β/2)(|Γ| − L*)². See `THEORY.md`, eq. (E3).

use super::{EnergyTerm, LengthJet};

/// Energy of the length.
#[derive(Clone, Debug)]
pub enum Length {
    /// Line tension σ, in energy per length.
    Tension(f64),
    /// Penalty β, in energy per length², on the distance from the target length L*.
    Penalty {
        /// Penalty β ≥ 0.
        penalty: f64,
        /// Target length L* > 0.
        target: f64,
    },
}

impl EnergyTerm for Length {
    fn name(&self) -> &'static str {
        "length"
    }

    fn of_length(&self, length: f64) -> LengthJet {
        match *self {
            Self::Tension(sigma) => LengthJet { value: sigma * length, first: sigma, second: 0.0 },
            Self::Penalty { penalty, target } => {
                let excess = length - target;
                LengthJet { value: 0.5 * penalty * excess * excess, first: penalty * excess, second: penalty }
            }
        }
    }
}
