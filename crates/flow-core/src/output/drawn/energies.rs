//! Energy over time.

use crate::run::{Frame, StepLog};

/// Time and energy of all frames and of one in `every` logged steps (and the last), in order of time: steps are closer where
/// the run is fast, frames where they outnumber the steps. Of what was saved and logged at one time, the saved energy stands.
pub(in crate::output) fn energy_over_time(frames: &[Frame], steps: &StepLog, every: usize) -> Vec<[f64; 2]> {
    let last = steps.time.len().saturating_sub(1);
    let logged = steps.time.iter().zip(&steps.energy).enumerate();
    let logged = logged.filter(|(k, _)| k % every == 0 || *k == last);
    let saved = frames.iter().map(|frame| [frame.time, frame.energy]);
    let mut all: Vec<_> = saved.chain(logged.map(|(_, (&time, &energy))| [time, energy])).collect();
    all.sort_by(|one, other| one[0].total_cmp(&other[0]));
    all.dedup_by(|next, kept| next[0] == kept[0]);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_steps_are_one_line() {
        let frame = |time, energy| Frame { time, energy, ..Frame::default() };
        let frames = [frame(0.0, 9.0), frame(1.0, 5.0), frame(2.0, 4.0)];
        let steps = StepLog { time: vec![1e-3, 1.0, 1.5], energy: vec![8.0, 5.5, 4.5], ..StepLog::default() };
        let all = [[0.0, 9.0], [1e-3, 8.0], [1.0, 5.0], [1.5, 4.5], [2.0, 4.0]];
        assert_eq!(energy_over_time(&frames, &steps, 1), all);
        assert_eq!(energy_over_time(&frames, &StepLog::default(), 1), [all[0], all[2], all[4]]);
    }

    #[test]
    fn a_long_log_keeps_its_ends() {
        let time: Vec<f64> = (0..10).map(f64::from).collect();
        let steps = StepLog { energy: time.clone(), time, ..StepLog::default() };
        let times = |every| energy_over_time(&[], &steps, every).iter().map(|at| at[0]).collect::<Vec<_>>();
        assert_eq!(times(4), [0.0, 4.0, 8.0, 9.0]);
        assert_eq!(times(1).len(), 10);
    }
}
