//! The adhesion scene to t = 0.2: converged length and energy, and the flow with the area held.

use flow_core::run::Record;

use crate::{largest_rise, last, run, shipped};

/// One run.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Number of nodes.
    pub nodes: u32,
    /// Tolerance.
    pub tolerance: f64,
    /// Accepted steps.
    pub steps: u64,
    /// |Γ|/|Γ₀|.
    pub length_ratio: f64,
    /// Energy at the end.
    pub energy: f64,
    /// Largest relative rise of the energy in a step.
    pub rise: f64,
    /// Largest relative change of the area over all frames.
    pub area_change: f64,
}

/// Runs at `tolerance` with `nodes` nodes under `mobility`.
#[must_use]
pub fn measure(mobility: &str, tolerance: f64, nodes: u32) -> Run {
    let (tolerance_text, nodes_text) = (format!("{tolerance:e}"), nodes.to_string());
    let changes = [
        ("flow.normal_mobility", mobility),
        ("accuracy.tolerance", tolerance_text.as_str()),
        ("accuracy.nodes", nodes_text.as_str()),
        ("output.frames", "20"),
    ];
    let record = run(&shipped("adhesion", &changes));
    let (first, end) = (&record.frames[0], last(&record));
    Run {
        nodes,
        tolerance,
        steps: record.counters.steps,
        length_ratio: end.length / first.length,
        energy: end.energy,
        rise: largest_rise(&record),
        area_change: area_change(&record),
    }
}

fn area_change(record: &Record) -> f64 {
    let start = record.frames[0].area;
    record.frames.iter().map(|frame| (frame.area / start - 1.0).abs()).fold(0.0, f64::max)
}

/// The value of the finest run with what it differs by from the next coarser in nodes and in tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Converged {
    /// |Γ|/|Γ₀| and its error.
    pub length_ratio: [f64; 2],
    /// Energy and its error.
    pub energy: [f64; 2],
}

/// Converged values: 512 nodes at the tolerance 1e-9, against 256 nodes and against the tolerance 1e-8.
#[must_use]
pub fn converged(mobility: &str) -> Converged {
    let best = measure(mobility, 1e-9, 512);
    let others = [measure(mobility, 1e-9, 256), measure(mobility, 1e-8, 512)];
    let with_error = |of: fn(&Run) -> f64| {
        let error = others.iter().map(|other| (of(other) - of(&best)).abs()).fold(0.0, f64::max);
        [of(&best), error]
    };
    Converged { length_ratio: with_error(|run| run.length_ratio), energy: with_error(|run| run.energy) }
}
