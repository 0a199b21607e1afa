//! What a step of the loop tells.

use super::Rejections;

/// What one accepted step did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// Time at its end.
    pub time: f64,
    /// Its size.
    pub size: f64,
    /// Order of the method.
    pub order: usize,
    /// Energy at its end.
    pub energy: f64,
    /// Energy that it lost, known to its rounding.
    pub lost: f64,
    /// Dissipation at its end.
    pub dissipation: f64,
    /// Dissipation there without what the implicit solve left in stiff modes, which dies before the next step.
    pub settled_dissipation: f64,
    /// Attempts rejected before it.
    pub rejections: Rejections,
}

#[cfg(test)]
impl StepReport {
    /// A step of these sizes that was taken at once.
    #[must_use]
    pub fn taken(time: f64, size: f64, [energy, lost]: [f64; 2], dissipation: f64) -> Self {
        let (settled_dissipation, rejections) = (dissipation, Rejections::default());
        Self { time, size, order: 1, energy, lost, dissipation, settled_dissipation, rejections }
    }
}
