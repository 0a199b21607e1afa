//! Steps that a stiff membrane costs, before and after it has come to the incompressible manifold.

use flow_core::run::{Record, Rejections};

use super::incompressible_limit::{STARTS, text};
use crate::{run, scene};

/// The ladder of compressibilities.
pub const EPSILONS: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
/// The tolerances compared.
pub const TOLERANCES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-8];
/// From here on the curve is on the manifold: ten times the largest ε.
pub const ON_THE_MANIFOLD: f64 = 0.1;
/// End of the runs.
pub const END: f64 = 1.0;

/// The work of one run.
#[derive(Clone, Copy, Debug)]
pub struct Work {
    /// Compressibility.
    pub epsilon: f64,
    /// Accepted steps before and after [`ON_THE_MANIFOLD`].
    pub steps: [u64; 2],
    /// Rejected attempts after it.
    pub rejections: Rejections,
}

/// Runs the ladder at `tolerance` from the oscillating start.
#[must_use]
pub fn measure(tolerance: f64) -> Vec<Work> {
    EPSILONS
        .iter()
        .map(|epsilon| work(*epsilon, &run(&scene(&text(STARTS[2].1, *epsilon, tolerance, END)))))
        .collect()
}

fn work(epsilon: f64, record: &Record) -> Work {
    let steps = &record.steps;
    let before = steps.time.iter().filter(|time| **time <= ON_THE_MANIFOLD).count();
    let after = steps.time.len() - before;
    let mut rejections = Rejections::default();
    for more in &steps.rejections[before..] {
        rejections.error += more.error;
        rejections.solver += more.solver;
        rejections.energy_rise += more.energy_rise;
        rejections.not_finite += more.not_finite;
    }
    Work { epsilon, steps: [before as u64, after as u64], rejections }
}
