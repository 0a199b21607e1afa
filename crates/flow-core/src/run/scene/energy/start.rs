//! What terms need that their tables do not say.

use crate::run::scene::Density;

/// The densities of a checked scene, and the curve at the start.
#[derive(Clone, Copy, Debug)]
pub(in crate::run) struct Start<'a> {
    pub densities: &'a [Density],
    /// Length of the initial curve.
    pub length: f64,
    /// Area that it encloses.
    pub area: f64,
    pub nodes: usize,
}

impl Start<'_> {
    /// Index of the density `name`.
    pub fn density(&self, name: &str) -> usize {
        let index = self.densities.iter().position(|density| density.name == name);
        index.expect("tables of a checked scene name its own densities")
    }
}
