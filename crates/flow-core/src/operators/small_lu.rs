//! Dense LU factorisation with row pivoting of a small matrix, in place.

use multiversion::multiversion;

use super::factorisation_error::FactorisationError;

/// A small square matrix and, in its place, its factors; pivoted.
#[derive(Clone, Debug)]
pub struct SmallLu {
    size: usize,
    /// Column by column: L below the diagonal, U on and above it.
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
        self.entries[column * self.size + row] += value;
    }

    /// Factorises the matrix that was filled in.
    ///
    /// # Errors
    /// [`FactorisationError`] at the first pivot that is zero or not finite.
    pub fn factorise(&mut self) -> Result<(), FactorisationError> {
        let bad = factorise(&mut self.entries, &mut self.swaps);
        bad.map_or(Ok(()), |(row, pivot)| Err(FactorisationError { row, pivot }))
    }

    /// Overwrites the right-hand side `x` by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        assert_eq!(x.len(), self.size, "length of the right-hand side");
        for (c, largest) in self.swaps.iter().enumerate() {
            x.swap(c, *largest);
        }
        substitute(&self.entries, x);
    }
}

/// Number and value of the first bad pivot.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn factorise(entries: &mut [f64], swaps: &mut [usize]) -> Option<(usize, f64)> {
    let size = swaps.len();
    for c in 0..size {
        let (known, after) = entries.split_at_mut((c + 1) * size);
        let column = &mut known[c * size..];
        let larger =
            |best: usize, row: usize| if column[row].abs() > column[best].abs() { row } else { best };
        let largest = (c..size).fold(c, larger);
        swaps[c] = largest;
        column.swap(c, largest);
        let pivot = column[c];
        if pivot == 0.0 || !pivot.is_finite() {
            return Some((c, pivot));
        }
        let (_, below) = column.split_at_mut(c + 1);
        for entry in &mut *below {
            *entry /= pivot;
        }
        for other in after.chunks_exact_mut(size) {
            other.swap(c, largest);
            let factor = other[c];
            other[c + 1..].iter_mut().zip(&*below).for_each(|(entry, l)| *entry -= factor * l);
        }
        known[..c * size].chunks_exact_mut(size).for_each(|before| before.swap(c, largest));
    }
    None
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn substitute(entries: &[f64], x: &mut [f64]) {
    let size = x.len();
    for (c, column) in entries.chunks_exact(size).enumerate() {
        let value = x[c];
        x[c + 1..].iter_mut().zip(&column[c + 1..]).for_each(|(x, entry)| *x -= value * entry);
    }
    for (c, column) in entries.chunks_exact(size).enumerate().rev() {
        x[c] /= column[c];
        let value = x[c];
        x[..c].iter_mut().zip(column).for_each(|(x, entry)| *x -= value * entry);
    }
}
