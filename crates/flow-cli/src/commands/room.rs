//! Warnings where a run as predicted has no room: in the memory of the machine, or in what a run may hold of frames.

use flow_core::run::Prediction;

use crate::print;

/// What does not fit, in sentences.
pub fn warnings(prediction: &Prediction) -> Vec<String> {
    in_memory(prediction.memory_bytes, machine_bytes()).into_iter().chain(in_frames(prediction)).collect()
}

fn in_frames(prediction: &Prediction) -> Option<String> {
    let error = prediction.check_frames().err()?;
    Some(format!("the run ends early if its nodes grow as predicted and no rest comes before: {error}"))
}

fn in_memory(needed: f64, machine: Option<f64>) -> Option<String> {
    let machine = machine.filter(|machine| needed > *machine)?;
    Some(format!(
        "the run takes about {} GB of memory, and this machine has {} GB; ask for fewer frames, nodes or fields",
        print::significant(needed / 1e9, 2),
        print::significant(machine / 1e9, 2)
    ))
}

/// Memory of this machine, where the system tells.
fn machine_bytes() -> Option<f64> {
    total_bytes(&std::fs::read_to_string("/proc/meminfo").ok()?)
}

fn total_bytes(meminfo: &str) -> Option<f64> {
    let total = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    Some(1024.0 * total.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_memory_of_a_machine_is_read_or_unknown() {
        assert_eq!(total_bytes("MemTotal:       24683820 kB\nMemFree: 1 kB\n"), Some(24_683_820.0 * 1024.0));
        for text in ["", "MemFree: 1 kB", "MemTotal: much", "MemTotal: many kB"] {
            assert_eq!(total_bytes(text), None, "{text}");
        }
    }

    #[test]
    fn only_a_machine_that_is_too_small_is_spoken_of() {
        assert_eq!(in_memory(75e9, None), None);
        assert_eq!(in_memory(75e9, Some(80e9)), None);
        let warning = in_memory(75e9, Some(24e9)).unwrap();
        assert!(warning.contains("75 GB") && warning.contains("24 GB"), "{warning}");
    }
}
