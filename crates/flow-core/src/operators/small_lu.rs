//! Dense LU factorisation with row pivoting of a small matrix, in place.

use super::cyclic_banded::FactorisationError;
use crate::geometry::vectors::{add_scaled, dot};

/// A square matrix and its factors.
#[derive(Clone, Debug)]
pub struct SmallLu {
    size: usize,
    /// Row by row: L below the diagonal, U on and above it.
    entries: Vec<f64>,
    swaps: Vec<usize>,
}

impl SmallLu {
    /// A zero matrix of `size` rows.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size], swaps: vec![0; size] }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] += value;
    }

    /// Factorises the matrix that was filled in.
    ///
    /// # Errors
    /// [`FactorisationError`] at the first pivot that is zero or not finite.
    pub fn factorise(&mut self) -> Result<(), FactorisationError> {
        let size = self.size;
        for c in 0..size {
            let magnitude = |row: usize| self.entries[row * size + c].abs();
            let largest =
                (c..size).fold(c, |best, row| if magnitude(row) > magnitude(best) { row } else { best });
            self.swaps[c] = largest;
            if largest != c {
                for k in 0..size {
                    self.entries.swap(c * size + k, largest * size + k);
                }
            }
            let pivot = self.entries[c * size + c];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(FactorisationError { row: c, pivot });
            }
            let (above, below) = self.entries.split_at_mut((c + 1) * size);
            let pivot_row = &above[c * size + c + 1..];
            for row in below.chunks_exact_mut(size) {
                let factor = row[c] / pivot;
                row[c] = factor;
                add_scaled(&mut row[c + 1..], -factor, pivot_row);
            }
        }
        Ok(())
    }

    /// Overwrites the right-hand side `x` by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let size = self.size;
        for (c, largest) in self.swaps.iter().enumerate() {
            x.swap(c, *largest);
        }
        for (r, row) in self.entries.chunks_exact(size).enumerate() {
            x[r] -= dot(&row[..r], &x[..r]);
        }
        for (r, row) in self.entries.chunks_exact(size).enumerate().rev() {
            x[r] = (x[r] - dot(&row[r + 1..], &x[r + 1..])) / row[r];
        }
    }
}
