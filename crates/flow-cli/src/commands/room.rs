//! Warnings where a run as predicted has no room: in the memory at hand, or in what a run may hold of frames.

use flow_core::run::Prediction;

use super::memory;
use crate::print;

/// What does not fit, in sentences.
pub fn warnings(prediction: &Prediction) -> Vec<String> {
    in_memory(prediction.memory_bytes, memory::at_hand()).into_iter().chain(in_frames(prediction)).collect()
}

fn in_frames(prediction: &Prediction) -> Option<String> {
    let error = prediction.check_frames().err()?;
    Some(format!("the run ends early if its nodes grow as predicted and no rest comes before: {error}"))
}

fn in_memory(needed: f64, at_hand: Option<f64>) -> Option<String> {
    let at_hand = at_hand.filter(|at_hand| needed > *at_hand)?;
    Some(format!(
        "the run takes about {} GB of memory, and may have {} GB here; ask for fewer frames, nodes or fields",
        print::significant(needed / 1e9, 2),
        print::significant(at_hand / 1e9, 2)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_machine_that_is_too_small_is_spoken_of() {
        assert_eq!(in_memory(75e9, None), None);
        assert_eq!(in_memory(75e9, Some(80e9)), None);
        let warning = in_memory(75e9, Some(24e9)).unwrap();
        assert!(warning.contains("75 GB") && warning.contains("24 GB"), "{warning}");
    }
}
