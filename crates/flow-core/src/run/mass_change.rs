//! How far the mass of a density is from its first value.

use super::record::{Frame, Record};

impl Record {
    /// Change of the mass of density number `k` since the first frame, relative to ∫|ρ| dσ there unless that is zero, one value per
    /// frame. The mass itself may be zero, up to rounding, where a density has both signs.
    /// # Panics
    /// If there is no such density.
    #[must_use]
    pub fn mass_changes(&self, k: usize) -> Vec<f64> {
        let Some(first) = self.frames.first() else { return Vec::new() };
        let content = content(first, k);
        let scale = if content == 0.0 { 1.0 } else { content };
        self.frames.iter().map(|frame| (frame.mass[k] - first.mass[k]) / scale).collect()
    }
}

/// ∫|ρ| dσ.
fn content(frame: &Frame, k: usize) -> f64 {
    let sum: f64 = frame.density[k].iter().zip(&frame.metric).map(|(rho, g)| rho.abs() * g).sum();
    sum / frame.metric.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::StepLog;

    fn changes(density: &[f64], masses: [f64; 2]) -> Vec<f64> {
        let frame = |mass| Frame {
            mass: vec![mass],
            metric: vec![2.0; density.len()],
            density: vec![density.to_vec()],
            ..Frame::default()
        };
        Record::of_frames_and_steps(masses.map(frame).into(), StepLog::default()).mass_changes(0)
    }

    #[test]
    fn rounding_of_a_mass_that_is_zero_stays_rounding() {
        assert!(changes(&[1.0, -1.0, 3.0, -3.0], [1e-16, 5e-16])[1] < 2e-16);
    }

    #[test]
    fn of_one_sign_it_is_relative_to_the_mass() {
        assert_eq!(changes(&[-1.0; 4], [-2.0, -3.0]), [0.0, -0.5]);
    }

    #[test]
    fn where_there_is_nothing_it_is_the_change_itself() {
        assert_eq!(changes(&[0.0; 4], [0.0, 3.0]), [0.0, 3.0]);
    }
}
