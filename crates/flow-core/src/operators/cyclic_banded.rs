//! LU factorisation of cyclic banded matrices, in segments that are eliminated side by side.
//!
//! The ring of unknowns is cut into segments; the last `B` unknowns of each separate it from the next. All
//! segments are eliminated at once, one in each lane of the vector registers, without pivoting (their leading
//! blocks are matrices with Dirichlet ends); what is left couples the separators, a small dense matrix, which is
//! pivoted. See `THEORY.md`, eq. (O2).

use super::band_factors::{Factors, LANES, Lane, eliminate, substitute_backward, substitute_forward};
use super::small_lu::SmallLu;

/// The matrix has no usable LU factorisation.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the banded matrix is singular to working precision: pivot {pivot:.3e} in row {row}")]
pub struct FactorisationError {
    /// Row of the pivot.
    pub row: usize,
    /// Its value.
    pub pivot: f64,
}

/// A cyclic matrix with `B` bands on each side of the diagonal.
///
/// Rows are numbered within their segment: first unit rows that make all segments equally long, then the interior,
/// then the `B` rows of the separator.
#[derive(Clone, Debug)]
pub struct CyclicBanded<const B: usize> {
    rows: usize,
    segments: usize,
    /// First row of each segment, and the end of the last.
    starts: Vec<usize>,
    factors: Factors<B>,
    separators: SmallLu,
    reduced: Vec<f64>,
    /// The right-hand side by segments, after `B` zeros.
    work: Vec<Lane>,
}

impl<const B: usize> CyclicBanded<B> {
    /// A zero matrix of `rows` ≥ 3`B` rows.
    #[must_use]
    pub fn new(rows: usize) -> Self {
        assert!(rows >= 3 * B, "a cyclic band of half-width {B} needs {} rows", 3 * B);
        let segments = (rows / (2 * B)).clamp(1, LANES);
        let starts: Vec<usize> = (0..=segments).map(|segment| segment * rows / segments).collect();
        let longest = rows.div_ceil(segments);
        let mut banded = Self {
            rows,
            segments,
            starts,
            factors: Factors {
                interior: longest - B,
                lower: vec![[[0.0; LANES]; B]; longest],
                diagonal: vec![[1.0; LANES]; longest],
                upper: vec![[[0.0; LANES]; B]; longest],
                right: vec![[[0.0; LANES]; B]; longest],
                bottom: vec![[[0.0; LANES]; B]; longest],
                corner: [[[0.0; LANES]; B]; B],
            },
            separators: SmallLu::new(segments * B),
            reduced: vec![0.0; segments * B],
            work: vec![[0.0; LANES]; B + longest],
        };
        banded.clear();
        banded
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of unit rows before the interior of a segment.
    fn padding(&self, segment: usize) -> usize {
        self.factors.diagonal.len() - (self.starts[segment + 1] - self.starts[segment])
    }

    /// Segment of a row, and its number in it.
    fn locate(&self, row: usize) -> (usize, usize) {
        let segment = ((row + 1) * self.segments - 1) / self.rows;
        (segment, self.padding(segment) + row - self.starts[segment])
    }

    /// Sets every entry to zero, ready to be filled again.
    pub fn clear(&mut self) {
        let unit_rows: [usize; LANES] =
            std::array::from_fn(|lane| if lane < self.segments { self.padding(lane) } else { usize::MAX });
        let factors = &mut self.factors;
        for block in [&mut factors.lower, &mut factors.upper, &mut factors.right, &mut factors.bottom] {
            block.fill([[0.0; LANES]; B]);
        }
        factors.corner = [[[0.0; LANES]; B]; B];
        for (row, diagonal) in factors.diagonal.iter_mut().enumerate() {
            *diagonal = unit_rows.map(|unit_rows| if row < unit_rows { 1.0 } else { 0.0 });
        }
    }

    /// Sets the entry in `row` and column `row + offset` (cyclic), |`offset`| ≤ `B`.
    pub fn set(&mut self, row: usize, offset: isize, value: f64) {
        let column = (row as isize + offset).rem_euclid(self.rows as isize) as usize;
        let ((segment, r), (column_segment, c)) = (self.locate(row), self.locate(column));
        let factors = &mut self.factors;
        if segment == column_segment && c as isize - r as isize == offset {
            match offset.signum() {
                -1 => factors.lower[r][B + c - r][segment] = value,
                0 => factors.diagonal[r][segment] = value,
                _ => factors.upper[r][c - r - 1][segment] = value,
            }
        } else if offset < 0 {
            factors.right[r][c - factors.interior][segment] = value;
        } else {
            factors.bottom[c][r - factors.interior][column_segment] = value;
        }
    }

    /// Sets consecutive entries of `row`, the first in column `row + first` (cyclic), none beyond the band.
    pub fn set_row(&mut self, row: usize, first: isize, values: &[f64]) {
        let (segment, r) = self.locate(row);
        let start = r as isize + first;
        let longest = self.factors.diagonal.len();
        if start < self.padding(segment) as isize || start as usize + values.len() > longest {
            for (k, value) in values.iter().enumerate() {
                self.set(row, first + k as isize, *value);
            }
            return;
        }
        let (before, rest) = values.split_at(-first as usize);
        let [diagonal, after @ ..] = rest else { return };
        for (entry, value) in self.factors.lower[r][B - before.len()..].iter_mut().zip(before) {
            entry[segment] = *value;
        }
        self.factors.diagonal[r][segment] = *diagonal;
        for (entry, value) in self.factors.upper[r].iter_mut().zip(after) {
            entry[segment] = *value;
        }
    }

    /// Factorises the matrix that was filled in.
    ///
    /// # Errors
    /// [`FactorisationError`] at the first pivot that is zero or not finite.
    pub fn factorise(&mut self) -> Result<(), FactorisationError> {
        if let Some((r, lane, pivot)) = eliminate(&mut self.factors) {
            return Err(FactorisationError { row: self.starts[lane] + r - self.padding(lane), pivot });
        }
        self.couple_separators();
        self.separators.factorise().map_err(|FactorisationError { row, pivot }| {
            let end = self.starts[row / B + 1];
            FactorisationError { row: end - B + row % B, pivot }
        })
    }

    /// The matrix of the separators; their rows in the segments keep the columns of the interior only.
    fn couple_separators(&mut self) {
        let (interior, segments) = (self.factors.interior, self.segments);
        let factors = &mut self.factors;
        self.separators.clear();
        for lane in 0..segments {
            let (here, before) = (lane * B, (lane + segments - 1) % segments * B);
            for i in 0..B {
                let row = interior + i;
                self.separators.add(here + i, here + i, factors.diagonal[row][lane]);
                for j in 0..B {
                    if j < i {
                        let entry = &mut factors.lower[row][B + j - i][lane];
                        self.separators.add(here + i, here + j, std::mem::take(entry));
                    } else if j > i {
                        self.separators.add(here + i, here + j, factors.upper[row][j - i - 1][lane]);
                    }
                    self.separators.add(here + i, before + j, factors.right[row][j][lane]);
                    self.separators.add(before + j, here + i, factors.bottom[row][j][lane]);
                    self.separators.add(before + i, before + j, factors.corner[i][j][lane]);
                }
            }
        }
    }

    /// Overwrites the right-hand side `x` by the solution.
    pub fn solve(&mut self, x: &mut [f64]) {
        assert_eq!(x.len(), self.rows, "length of the right-hand side");
        let (interior, segments) = (self.factors.interior, self.segments);
        for lane in 0..segments {
            let values = &x[self.starts[lane]..self.starts[lane + 1]];
            let first = B + self.padding(lane);
            for (row, value) in self.work[first..].iter_mut().zip(values) {
                row[lane] = *value;
            }
        }
        let tail = substitute_forward(&self.factors, &mut self.work);
        for lane in 0..segments {
            for i in 0..B {
                self.reduced[lane * B + i] = self.work[B + interior + i][lane];
            }
        }
        for lane in 0..segments {
            let before = (lane + segments - 1) % segments * B;
            for (b, tail) in tail.iter().enumerate() {
                self.reduced[before + b] += tail[lane];
            }
        }
        self.separators.solve(&mut self.reduced);
        let mut previous = [[0.0; LANES]; B];
        for lane in 0..segments {
            let before = (lane + segments - 1) % segments * B;
            for i in 0..B {
                self.work[B + interior + i][lane] = self.reduced[lane * B + i];
                previous[i][lane] = self.reduced[before + i];
            }
        }
        substitute_backward(&self.factors, &previous, &mut self.work);
        for lane in 0..segments {
            let first = B + self.padding(lane);
            let values = &mut x[self.starts[lane]..self.starts[lane + 1]];
            for (value, row) in values.iter_mut().zip(&self.work[first..]) {
                *value = row[lane];
            }
        }
    }
}
