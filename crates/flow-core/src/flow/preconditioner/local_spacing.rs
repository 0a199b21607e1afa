//! The local spacing of graded nodes, for the band. See `THEORY.md`, eq. (O7).

use crate::geometry::Grading;

/// A grading at the coarse nodes: the band is that of the pointwise fields, the spectra are those of w times them.
#[derive(Debug)]
pub struct LocalSpacing {
    /// w and 1/w at the coarse nodes.
    pub weight: Vec<f64>,
    pub inverse: Vec<f64>,
    /// Second differences that hold the grading exactly.
    pub differences: Vec<[f64; 3]>,
}

impl LocalSpacing {
    /// On `nodes` coarse nodes.
    pub fn new(grading: &Grading, nodes: usize) -> Self {
        let weight: Vec<f64> = (0..nodes).map(|i| grading.at(i as f64 / nodes as f64)).collect();
        let difference = |i| {
            let [left, right] = grading.spacing(i, nodes);
            [left, -left - right, right]
        };
        Self {
            inverse: weight.iter().map(|w| 1.0 / w).collect(),
            weight,
            differences: (0..nodes).map(difference).collect(),
        }
    }
}
