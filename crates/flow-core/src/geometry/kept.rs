//! What is kept for the numbers of nodes that a run comes back to.

use std::collections::HashMap;

/// Numbers for which something is kept.
const MOST: usize = 64;

/// A value for each of a few numbers of nodes; meant for one thread.
#[derive(Debug)]
pub(super) struct Kept<T>(HashMap<usize, T>);

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<T: Clone> Kept<T> {
    /// The value for `nodes`, made if there is none.
    pub fn of(&mut self, nodes: usize, make: impl FnOnce() -> T) -> T {
        if self.0.len() >= MOST {
            self.0.clear();
        }
        self.0.entry(nodes).or_insert_with(make).clone()
    }
}
