//! What a sum is made of, to read.

use super::EnergySum;
use crate::energies::Jet;
use crate::geometry::Layout;

impl EnergySum {
    /// Shape of the states.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Names of the terms.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.terms.iter().map(|term| term.name())
    }

    /// Bytes that the terms keep for second derivatives beside a few numbers for each node.
    #[must_use]
    pub fn kept_bytes(&self) -> f64 {
        self.terms.iter().map(|term| term.kept_bytes()).sum()
    }

    /// Pointwise second derivatives at the state evaluated last with [`EnergySum::linearise`].
    #[must_use]
    pub fn jet(&self) -> &Jet {
        &self.jet
    }
}
