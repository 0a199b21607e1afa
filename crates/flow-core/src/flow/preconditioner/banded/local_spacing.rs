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
        let zero = vec![0.0; nodes];
        let mut local = Self { weight: zero.clone(), inverse: zero, differences: vec![[0.0; 3]; nodes] };
        local.set(grading);
        local
    }

    /// Takes another grading.
    pub fn set(&mut self, grading: &Grading) {
        let nodes = self.weight.len();
        for i in 0..nodes {
            self.weight[i] = grading.at(i as f64 / nodes as f64);
            self.inverse[i] = 1.0 / self.weight[i];
            let [left, right] = grading.spacing(i, nodes);
            self.differences[i] = [left, -left - right, right];
        }
    }
}
