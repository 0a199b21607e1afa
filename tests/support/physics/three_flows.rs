//! The trillium under bending at t = 0.01, its length held in three ways: the last figure of the paper.

use flow_core::run::{Frame, Record};

use super::alignment::Aligned;
use super::fields::correlation;
use crate::{largest_rise, last, mean, run, shipped};

/// Scene, and how it holds the length.
pub const FLOWS: [(&str, &str); 3] = [
    ("length_penalty", "total length, β = 5"),
    ("membrane_penalty", "membrane, ε = 0.01"),
    ("incompressible", "every piece, 𝓘"),
];

/// What the three flows have come to.
#[derive(Clone, Debug)]
pub struct ThreeFlows {
    /// One per entry of [`FLOWS`].
    pub flows: Vec<Flow>,
    /// Length-penalised curve first, incompressible curve second.
    pub aligned: Aligned,
    /// Length-penalised curve first, membrane second.
    pub membrane_aligned: Aligned,
    /// Correlation of ρ − 1 with the curvature over the nodes.
    pub correlation: f64,
    /// Largest ρ − 1 of each lobe of low curvature, and the curvature there; in order along the curve.
    pub peaks: Vec<[f64; 2]>,
    /// Mean of ρ − 1.
    pub mean_excess: f64,
    /// The distance of the membrane from the incompressible manifold, and its velocity residual relative to the velocity.
    pub membrane: [f64; 2],
}

/// One of the flows.
#[derive(Clone, Debug)]
pub struct Flow {
    /// Steps taken.
    pub steps: u64,
    /// Length over initial length.
    pub length_ratio: f64,
    /// Largest relative change of the length over all frames.
    pub length_change: f64,
    /// Bending energy.
    pub bending: f64,
    /// Length²/(4π area): 1 for a circle.
    pub roundness: f64,
    /// Largest relative rise of the energy in a step.
    pub rise: f64,
}

/// Runs the three scenes at `tolerance` with `nodes` nodes.
#[must_use]
pub fn measure(tolerance: &str, nodes: &str) -> ThreeFlows {
    let changes = [("accuracy.tolerance", tolerance), ("accuracy.nodes", nodes), ("output.frames", "20")];
    let records: Vec<Record> = FLOWS.iter().map(|(name, _)| run(&shipped(name, &changes))).collect();
    let [penalised, membrane, incompressible] = [0, 1, 2].map(|flow: usize| last(&records[flow]));
    let excess: Vec<f64> = membrane.density[0].iter().map(|rho| rho - 1.0).collect();
    let speed =
        (membrane.length * mean(&membrane.normal_velocity.iter().map(|v| v * v).collect::<Vec<_>>())).sqrt();
    ThreeFlows {
        flows: records.iter().map(flow).collect(),
        aligned: Aligned::new(&penalised.position, &incompressible.position, 1440),
        membrane_aligned: Aligned::new(&penalised.position, &membrane.position, 1440),
        correlation: correlation(&excess, &membrane.curvature),
        peaks: peaks(&excess).into_iter().map(|node| [excess[node], membrane.curvature[node]]).collect(),
        mean_excess: mean(&excess),
        membrane: [membrane.diagnostics[0], membrane.diagnostics[1] / speed],
    }
}

fn flow(record: &Record) -> Flow {
    let (start, end) = (record.frames[0].length, last(record));
    let change = |frame: &Frame| (frame.length / start - 1.0).abs();
    Flow {
        steps: record.counters.steps,
        length_ratio: end.length / start,
        length_change: record.frames.iter().map(change).fold(0.0, f64::max),
        bending: end.energy_terms[0],
        roundness: end.length * end.length / (4.0 * std::f64::consts::PI * end.area),
        rise: largest_rise(record),
    }
}

/// Nodes of the local maxima of a periodic field.
fn peaks(values: &[f64]) -> Vec<usize> {
    let n = values.len();
    (0..n).filter(|i| values[*i] > values[(i + n - 1) % n] && values[*i] >= values[(i + 1) % n]).collect()
}
