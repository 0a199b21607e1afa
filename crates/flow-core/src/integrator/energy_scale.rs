//! What a flow can change of its energy: `THEORY.md`, eq. (I14).

/// Part of the energy lost that counts as the scale at least: what is left may pass through zero.
const PART_OF_LOSS: f64 = 1e-3;

/// What errors of the energy are relative to: what the flow can change, as far as that is known.
///
/// It is at most the energy, at most what is left of it without a constant of the motion, or a thousandth of what has been lost: a constant
/// that hides all else would let steps be as wrong as they like, and the flow seem to be at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyScale {
    constant: f64,
    initial: f64,
}

impl EnergyScale {
    /// That of a flow from the energy `initial`, of which `constant` is a constant of the motion; 0 if nothing is known to be one.
    #[must_use]
    pub fn new(initial: f64, constant: f64) -> Self {
        Self { constant, initial }
    }

    /// The constant of the motion in the energy; 0 if nothing is known to be one.
    #[must_use]
    pub fn constant(self) -> f64 {
        self.constant
    }

    /// What the flow can change of the energy `energy`.
    #[must_use]
    pub fn of(self, energy: f64) -> f64 {
        energy.abs().min((energy - self.constant).abs().max(PART_OF_LOSS * (self.initial - energy)))
    }

    /// The same, but a thousandth of what was lost at least: what counts as small of an energy that fell to nearly zero.
    #[must_use]
    pub fn with_loss(self, energy: f64) -> f64 {
        self.of(energy).max(PART_OF_LOSS * (self.initial - energy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_constant_it_is_the_energy() {
        for (initial, energy) in [(3.0, 2.0), (3.0, -2.0), (3.0, 1e-9), (-1.0, -4.0)] {
            assert_eq!(EnergyScale::new(initial, 0.0).of(energy), f64::abs(energy));
        }
        assert_eq!(EnergyScale::new(3.0, 0.0).with_loss(1.0), 1.0);
        assert!((EnergyScale::new(3.0, 0.0).with_loss(1e-6) - 3e-3).abs() < 1e-8);
    }

    #[test]
    fn a_constant_does_not_count() {
        assert_eq!(EnergyScale::new(1003.0, 1000.0).of(1002.0), 2.0);
        // Nor does it make the scale any larger, as of ∫(a − 1)² dσ, a near 1.
        assert_eq!(EnergyScale::new(1e-3, 6.0).of(1e-4), 1e-4);
        // What is left may pass through zero; what was lost is no zero then.
        assert_eq!(EnergyScale::new(9.0, 6.0).of(6.0), 3e-3);
        // What a transient has lost does not bring the constant back.
        assert_eq!(EnergyScale::new(1080.0, 1000.0).of(1000.125), 0.125);
    }
}
