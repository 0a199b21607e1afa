//! Vectors by blocks of as many entries as are computed at a time.

use std::ops::{Deref, DerefMut};

use super::moments::LANES;

/// Entries of a block: those that belong to the pairs of a block of moments.
pub const ENTRIES: usize = 2 * LANES;
pub type Entries = [f64; ENTRIES];

/// A vector whose last block is filled up with zeros, which sums over vectors leave zero: they need no case of their own for its end.
#[derive(Clone, Debug)]
pub struct Blocked {
    blocks: Vec<Entries>,
    entries: usize,
}

impl Blocked {
    /// Zero, of `entries` entries.
    pub fn new(entries: usize) -> Self {
        Self { blocks: vec![[0.0; ENTRIES]; entries.div_ceil(ENTRIES)], entries }
    }

    /// All of its blocks.
    pub fn blocks(&self) -> &[Entries] {
        &self.blocks
    }

    /// The same, to be written.
    pub fn blocks_mut(&mut self) -> &mut [Entries] {
        &mut self.blocks
    }
}

impl Deref for Blocked {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.blocks.as_flattened()[..self.entries]
    }
}

impl DerefMut for Blocked {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.blocks.as_flattened_mut()[..self.entries]
    }
}
