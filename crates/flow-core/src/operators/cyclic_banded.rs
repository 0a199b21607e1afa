//! LU factorisation of cyclic banded matrices: the last `B` unknowns are a dense border around a band.
//! See `THEORY.md`, eq. (O2).

/// The matrix has no usable LU factorisation.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the banded matrix is singular to working precision: pivot {pivot:.3e} in row {row}")]
pub struct FactorisationError {
    /// Row of the pivot.
    pub row: usize,
    /// Its value.
    pub pivot: f64,
}

/// A cyclic matrix with `B` bands on each side of the diagonal, factorised without pivoting in the band
/// (its leading block is a matrix with Dirichlet ends) and with pivoting in the `B × B` corner.
#[derive(Clone, Debug)]
pub struct CyclicBanded<const B: usize> {
    rows: usize,
    /// Row r holds the entries of columns r−B … r+B: left part, becomes L.
    lower: Vec<[f64; B]>,
    diagonal: Vec<f64>,
    upper: Vec<[f64; B]>,
    /// Entries of the core rows in the border columns.
    right: Vec<[f64; B]>,
    /// Entries of the border rows in the core columns, stored by core column.
    bottom: Vec<[f64; B]>,
    corner: [[f64; B]; B],
    swaps: [usize; B],
}

impl<const B: usize> CyclicBanded<B> {
    /// A zero matrix of `rows` ≥ 3`B` rows.
    #[must_use]
    pub fn new(rows: usize) -> Self {
        assert!(rows >= 3 * B, "a cyclic band of half-width {B} needs {} rows", 3 * B);
        let core = rows - B;
        Self {
            rows,
            lower: vec![[0.0; B]; core],
            diagonal: vec![0.0; core],
            upper: vec![[0.0; B]; core],
            right: vec![[0.0; B]; core],
            bottom: vec![[0.0; B]; core],
            corner: [[0.0; B]; B],
            swaps: [0; B],
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Sets every entry to zero, ready to be filled again.
    pub fn clear(&mut self) {
        for block in [&mut self.lower, &mut self.upper, &mut self.right, &mut self.bottom] {
            block.fill([0.0; B]);
        }
        self.diagonal.fill(0.0);
        self.corner = [[0.0; B]; B];
    }

    /// Sets the entry in `row` and column `row + offset` (cyclic), |`offset`| ≤ `B`.
    pub fn set(&mut self, row: usize, offset: isize, value: f64) {
        let (rows, core) = (self.rows, self.rows - B);
        let column = (row as isize + offset).rem_euclid(rows as isize) as usize;
        match (row < core, column < core) {
            (true, true) if column < row => self.lower[row][B + column - row] = value,
            (true, true) if column == row => self.diagonal[row] = value,
            (true, true) => self.upper[row][column - row - 1] = value,
            (true, false) => self.right[row][column - core] = value,
            (false, true) => self.bottom[column][row - core] = value,
            (false, false) => self.corner[row - core][column - core] = value,
        }
    }

    /// Sets a whole row of a cleared matrix: the entries of the columns row−`B` … row−1, row, row+1 … row+`B` (cyclic).
    pub fn set_row(&mut self, row: usize, lower: [f64; B], diagonal: f64, upper: [f64; B]) {
        if row >= B && row + B < self.rows - B {
            self.lower[row] = lower;
            self.diagonal[row] = diagonal;
            self.upper[row] = upper;
            return;
        }
        self.set(row, 0, diagonal);
        for k in 0..B {
            self.set(row, k as isize - B as isize, lower[k]);
            self.set(row, k as isize + 1, upper[k]);
        }
    }

    /// Factorises the matrix that was filled in.
    ///
    /// # Errors
    /// [`FactorisationError`] at the first pivot that is zero or not finite.
    pub fn factorise(&mut self) -> Result<(), FactorisationError> {
        let core = self.rows - B;
        for r in 0..core {
            let pivot = self.diagonal[r];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(FactorisationError { row: r, pivot });
            }
            let inverse = 1.0 / pivot;
            self.diagonal[r] = inverse;
            let (upper, right) = (self.upper[r], self.right[r]);
            for j in 1..=B.min(core - 1 - r) {
                let target = r + j;
                let factor = self.lower[target][B - j] * inverse;
                self.lower[target][B - j] = factor;
                for k in 0..B {
                    // Column r + 1 + k of row r + j.
                    let column = k + 1;
                    match column.cmp(&j) {
                        std::cmp::Ordering::Less => self.lower[target][B + column - j] -= factor * upper[k],
                        std::cmp::Ordering::Equal => self.diagonal[target] -= factor * upper[k],
                        std::cmp::Ordering::Greater => {
                            self.upper[target][column - j - 1] -= factor * upper[k];
                        }
                    }
                }
                for k in 0..B {
                    self.right[target][k] -= factor * right[k];
                }
            }
            let mut bottom = self.bottom[r];
            for value in &mut bottom {
                *value *= inverse;
            }
            self.bottom[r] = bottom;
            for k in 0..B.min(core - 1 - r) {
                for b in 0..B {
                    self.bottom[r + 1 + k][b] -= bottom[b] * upper[k];
                }
            }
            for b in 0..B {
                for k in 0..B {
                    self.corner[b][k] -= bottom[b] * right[k];
                }
            }
        }
        self.factorise_corner()
    }

    /// LU of the corner with row pivoting.
    fn factorise_corner(&mut self) -> Result<(), FactorisationError> {
        for c in 0..B {
            let largest = (c..B).fold(c, |best, row| {
                if self.corner[row][c].abs() > self.corner[best][c].abs() { row } else { best }
            });
            self.swaps[c] = largest;
            self.corner.swap(c, largest);
            let pivot = self.corner[c][c];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(FactorisationError { row: self.rows - B + c, pivot });
            }
            let pivot_row = self.corner[c];
            for row in &mut self.corner[c + 1..] {
                let factor = row[c] / pivot;
                row[c] = factor;
                for k in c + 1..B {
                    row[k] -= factor * pivot_row[k];
                }
            }
        }
        Ok(())
    }

    /// Overwrites the right-hand side `x` by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        assert_eq!(x.len(), self.rows, "length of the right-hand side");
        let core = self.rows - B;
        let (body, border) = x.split_at_mut(core);
        let mut tail = [0.0; B];
        tail.copy_from_slice(border);
        // Both substitutions keep the last B solved entries in registers.
        let mut window = [0.0; B];
        for ((value, lower), bottom) in body.iter_mut().zip(&self.lower).zip(&self.bottom) {
            let mut sum = *value;
            for k in 0..B {
                sum -= lower[k] * window[k];
            }
            for b in 0..B {
                tail[b] -= bottom[b] * sum;
            }
            for k in 1..B {
                window[k - 1] = window[k];
            }
            window[B - 1] = sum;
            *value = sum;
        }
        self.solve_corner(&mut tail);
        border.copy_from_slice(&tail);
        let mut window = [0.0; B];
        let rows = self.upper.iter().zip(&self.right).zip(&self.diagonal);
        for (value, ((upper, right), inverse)) in body.iter_mut().zip(rows).rev() {
            let mut sum = *value;
            for b in 0..B {
                sum -= right[b] * tail[b];
            }
            // The newest value last, so that a row waits for one product only.
            for k in (0..B).rev() {
                sum -= upper[k] * window[k];
            }
            sum *= inverse;
            for k in (1..B).rev() {
                window[k] = window[k - 1];
            }
            window[0] = sum;
            *value = sum;
        }
    }

    fn solve_corner(&self, tail: &mut [f64; B]) {
        for c in 0..B {
            tail.swap(c, self.swaps[c]);
        }
        for c in 0..B {
            for row in c + 1..B {
                tail[row] -= self.corner[row][c] * tail[c];
            }
        }
        for c in (0..B).rev() {
            for k in c + 1..B {
                tail[c] -= self.corner[c][k] * tail[k];
            }
            tail[c] /= self.corner[c][c];
        }
    }
}
