//! Who watches a ladder: told before every run, then after every step of it.

use super::super::observer::{Observer, Quiet};
use crate::run::scene::Nodes;

/// A run of the ladder that is about to start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Leg {
    /// Finds the times at which all others are compared.
    Scout {
        /// The tolerance of the scene.
        tolerance: f64,
    },
    /// What the others are compared with.
    Reference {
        /// Its tolerance.
        tolerance: f64,
        /// Its number of nodes.
        nodes: Nodes,
    },
    /// One that is measured.
    Rung {
        /// Its tolerance.
        tolerance: f64,
        /// Counts the rungs from 1.
        number: usize,
        /// Number of rungs.
        count: usize,
    },
}

/// Watches a ladder.
pub trait LadderObserver: Observer {
    /// Called before every run, but not before those that only repeat one to measure its time again.
    fn before_run(&mut self, _leg: &Leg) {}
}

impl LadderObserver for Quiet {}
