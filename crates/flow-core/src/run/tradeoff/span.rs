//! When runs are compared: at the end of the flow and halfway through its energy.

use super::super::record::{Record, StopReason};

/// The times at which all runs of a ladder are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Time at which half of the energy that is lost until the end is lost.
    pub halfway: f64,
    /// Time at which all runs end.
    pub end: f64,
    /// Why they end there.
    pub ending: Ending,
}

/// Why the scout ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The end time of the scene.
    EndTime,
    /// The flow was at rest.
    Equilibrium,
    /// The curve was in contact with itself.
    Contact,
}

impl Ending {
    /// Short name, as in the record of a run: `end-time`, `equilibrium` or `contact`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::EndTime => StopReason::EndTime.name(),
            Self::Equilibrium => StopReason::Equilibrium.name(),
            Self::Contact => StopReason::Contact.name(),
        }
    }
}

/// The time at which the energy of a finished run stood in the middle between its first and its last value, linear within
/// a step; half the end time for a run that loses no energy.
pub(super) fn halfway(record: &Record) -> f64 {
    let (start, end) = (&record.frames[0], &record.frames[record.frames.len() - 1]);
    let middle = 0.5 * (start.energy + end.energy);
    let mut before = (start.time, start.energy);
    for (&time, &energy) in record.steps.time.iter().zip(&record.steps.energy) {
        if energy <= middle && energy < before.1 {
            let part = (before.1 - middle) / (before.1 - energy);
            // Strictly inside: the frames at both ends are others.
            return before.0 + part.clamp(1e-3, 1.0 - 1e-3) * (time - before.0);
        }
        before = (time, energy);
    }
    0.5 * end.time
}

#[cfg(test)]
mod tests {
    use super::super::super::provenance::Provenance;
    use super::super::super::record::{Frame, StepLog};
    use super::super::super::seconds::Seconds;
    use super::*;
    use crate::integrator::Counters;

    fn record(times: &[f64], energies: &[f64]) -> Record {
        let frame = |i: usize| Frame { time: times[i], energy: energies[i], ..Frame::default() };
        Record {
            title: String::new(),
            scene: String::new(),
            resolved_scene: String::new(),
            energy_terms: Vec::new(),
            densities: Vec::new(),
            fields: Vec::new(),
            diagnostics: Vec::new(),
            frames: vec![frame(0), frame(times.len() - 1)],
            steps: StepLog {
                time: times[1..].to_vec(),
                energy: energies[1..].to_vec(),
                ..StepLog::default()
            },
            counters: Counters::default(),
            seconds: Seconds::default(),
            stop_reason: StopReason::EndTime,
            provenance: Provenance::here(),
        }
    }

    #[test]
    fn half_of_the_loss_is_found_within_a_step() {
        assert_eq!(halfway(&record(&[0.0, 1.0, 3.0, 9.0], &[10.0, 8.0, 4.0, 2.0])), 2.0);
        assert_eq!(halfway(&record(&[0.0, 1.0, 4.0], &[5.0, 5.0, 5.0])), 2.0);
    }
}
