//! When runs are compared: at the end of the flow and halfway through its energy.

use super::super::record::{Record, StopReason};

/// Bisections that find a time within a step, to rounding of what that is good for.
const BISECTIONS: usize = 40;

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

/// The time at which the energy of a finished run stood in the middle between its first and its last value; half the end time for a run that loses no energy.
pub(super) fn halfway(record: &Record) -> f64 {
    let (start, end) = (&record.frames[0], &record.frames[record.frames.len() - 1]);
    let middle = 0.5 * (start.energy + end.energy);
    let mut before = (start.time, start.energy, start.dissipation);
    let steps = &record.steps;
    for ((&time, &energy), &dissipation) in steps.time.iter().zip(&steps.energy).zip(&steps.dissipation) {
        let (size, loss) = (time - before.0, before.1 - energy);
        if energy <= middle && loss > 0.0 {
            let slopes = [before.2, dissipation].map(|dissipation| size * dissipation / loss);
            let part = part_at((before.1 - middle) / loss, slopes);
            // Strictly inside: the frames at both ends are others.
            return before.0 + part.clamp(1e-3, 1.0 - 1e-3) * size;
        }
        before = (time, energy, dissipation);
    }
    0.5 * end.time
}

/// Where the monotone cubic from 0 to 1 on [0, 1] with those `slopes` at its ends has the value `value`: slopes of more than three times
/// that of the line, as implicit solves leave in dissipations, are cut off.
fn part_at(value: f64, slopes: [f64; 2]) -> f64 {
    let [first, last] = slopes.map(|slope| slope.clamp(0.0, 3.0));
    let cubic = |x: f64| x * (first + x * (3.0 - 2.0 * first - last + x * (first + last - 2.0)));
    let mut bracket = [0.0, 1.0];
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (bracket[0] + bracket[1]);
        bracket[usize::from(cubic(middle) >= value)] = middle;
    }
    bracket[1]
}

#[cfg(test)]
mod tests {
    use super::super::super::record::{Frame, StepLog};
    use super::*;

    fn record(times: &[f64], energies: &[f64], dissipations: &[f64]) -> Record {
        let frame = |i: usize| Frame {
            time: times[i],
            energy: energies[i],
            dissipation: dissipations[i],
            ..Frame::default()
        };
        let steps = StepLog {
            time: times[1..].to_vec(),
            energy: energies[1..].to_vec(),
            dissipation: dissipations[1..].to_vec(),
            ..StepLog::default()
        };
        Record::of_frames_and_steps(vec![frame(0), frame(times.len() - 1)], steps)
    }

    #[test]
    fn half_of_the_loss_is_found_within_a_step() {
        assert_eq!(halfway(&record(&[0.0, 1.0, 3.0, 9.0], &[10.0, 8.0, 4.0, 2.0], &[2.0; 4])), 2.0);
        assert_eq!(halfway(&record(&[0.0, 1.0, 4.0], &[5.0; 3], &[0.0; 3])), 2.0);
    }

    #[test]
    fn within_a_step_the_energy_falls_as_its_dissipation_says() {
        let times = [0.0, 0.2, 1.2, 2.0_f64];
        let energies = times.map(|t| (-t).exp());
        let exact = -(0.5 * (1.0 + energies[3])).ln();
        assert!((halfway(&record(&times, &energies, &energies)) - exact).abs() < 3e-3);
        // What an implicit solve leaves in a dissipation does not lead out of the step.
        let spoilt = [energies[0], energies[1], 1e9, energies[3]];
        assert!((0.2..1.2).contains(&halfway(&record(&times, &energies, &spoilt))));
    }
}
