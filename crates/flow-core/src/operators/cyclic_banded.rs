//! LU factorisation of cyclic banded matrices, in segments that are eliminated side by side.
//!
//! The ring of unknowns is cut into segments; the last `B` unknowns of each separate it from the next. All
//! segments are eliminated at once, one in each lane of the vector registers, without pivoting (their leading
//! blocks are matrices with Dirichlet ends); what is left couples the separators, a small dense matrix, which is
//! pivoted. See `THEORY.md`, eq. (O2).

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

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

/// Segments eliminated at once: one register of the widest kind.
const LANES: usize = 8;

/// One value for each segment.
type Lane = [f64; LANES];

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

/// The matrix by segments; factorised in place.
#[derive(Clone, Debug)]
struct Factors<const B: usize> {
    /// Rows of a segment before its separator.
    interior: usize,
    /// Entries left of the diagonal; becomes L.
    lower: Vec<[Lane; B]>,
    /// Becomes the inverse of U's diagonal.
    diagonal: Vec<Lane>,
    upper: Vec<[Lane; B]>,
    /// Entries in the columns of the separator before the segment.
    right: Vec<[Lane; B]>,
    /// Entries in the rows of the separator before the segment, by column.
    bottom: Vec<[Lane; B]>,
    /// What the elimination adds to the block of the separator before the segment.
    corner: [[Lane; B]; B],
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

/// a −= b c, lane by lane.
#[inline(always)]
fn subtract_product(a: &mut Lane, b: &Lane, c: &Lane) {
    for lane in 0..LANES {
        a[lane] -= b[lane] * c[lane];
    }
}

/// Eliminates the interiors; row, lane and value of the first bad pivot.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn eliminate<const B: usize>(factors: &mut Factors<B>) -> Option<(usize, usize, f64)> {
    for r in 0..factors.interior {
        let pivot = factors.diagonal[r];
        let inverse = pivot.map(|value| 1.0 / value);
        if let Some(lane) = inverse.iter().position(|value| !value.is_finite() || *value == 0.0) {
            return Some((r, lane, pivot[lane]));
        }
        factors.diagonal[r] = inverse;
        let (upper, right) = (factors.upper[r], factors.right[r]);
        for j in 1..=B {
            let target = r + j;
            let mut factor = factors.lower[target][B - j];
            for lane in 0..LANES {
                factor[lane] *= inverse[lane];
            }
            factors.lower[target][B - j] = factor;
            // Column r + 1 + k of row r + j.
            for k in 0..j - 1 {
                subtract_product(&mut factors.lower[target][B + k + 1 - j], &factor, &upper[k]);
            }
            subtract_product(&mut factors.diagonal[target], &factor, &upper[j - 1]);
            for k in j..B {
                subtract_product(&mut factors.upper[target][k - j], &factor, &upper[k]);
            }
            for k in 0..B {
                subtract_product(&mut factors.right[target][k], &factor, &right[k]);
            }
        }
        let mut bottom = factors.bottom[r];
        for value in &mut bottom {
            for lane in 0..LANES {
                value[lane] *= inverse[lane];
            }
        }
        factors.bottom[r] = bottom;
        for k in 0..B {
            for b in 0..B {
                subtract_product(&mut factors.bottom[r + 1 + k][b], &bottom[b], &upper[k]);
                subtract_product(&mut factors.corner[b][k], &bottom[b], &right[k]);
            }
        }
    }
    None
}

/// L-solve of `work`; returns what goes to the separators before the segments.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn substitute_forward<const B: usize>(factors: &Factors<B>, work: &mut [Lane]) -> [Lane; B] {
    let mut tail = [[0.0; LANES]; B];
    for (r, lower) in factors.lower.iter().enumerate() {
        let mut sum = work[B + r];
        for k in 0..B {
            subtract_product(&mut sum, &lower[k], &work[r + k]);
        }
        work[B + r] = sum;
        if r < factors.interior {
            for (tail, bottom) in tail.iter_mut().zip(&factors.bottom[r]) {
                subtract_product(tail, bottom, &sum);
            }
        }
    }
    tail
}

/// U-solve of `work`, whose separators are solved; `previous` holds those before the segments.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn substitute_backward<const B: usize>(factors: &Factors<B>, previous: &[Lane; B], work: &mut [Lane]) {
    for r in (0..factors.interior).rev() {
        let mut sum = work[B + r];
        for (right, previous) in factors.right[r].iter().zip(previous) {
            subtract_product(&mut sum, right, previous);
        }
        // The newest value last, so that a row waits for one product only.
        for k in (0..B).rev() {
            subtract_product(&mut sum, &factors.upper[r][k], &work[B + r + 1 + k]);
        }
        for lane in 0..LANES {
            sum[lane] *= factors.diagonal[r][lane];
        }
        work[B + r] = sum;
    }
}
