//! LU factorisation of cyclic banded matrices, in segments that are eliminated side by side.
//!
//! The ring of unknowns is cut into segments; the last `B` unknowns of each separate it from the next. All
//! segments are eliminated at once, one in each lane of the vector registers, without pivoting (their leading
//! blocks are matrices with Dirichlet ends); what is left couples the separators, a small dense matrix, which is
//! pivoted. See `THEORY.md`, eq. (O2).

use std::ops::Range;

use super::band_factors::{Factors, LANES, Lane, eliminate, substitute_backward, substitute_forward};
use super::factorisation_error::FactorisationError;
use super::small_lu::SmallLu;

/// A cyclic matrix with `B` bands on each side of the diagonal.
///
/// Rows have a place within their segment: first unit rows that make all segments equally long, then the interior,
/// then the `B` rows of the separator.
#[derive(Clone, Debug)]
pub struct CyclicBanded<const B: usize> {
    rows: usize,
    /// Rows that belong together.
    block: usize,
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
    ///
    /// # Panics
    /// If there are fewer, or `B` is 0.
    #[must_use]
    pub fn new(rows: usize) -> Self {
        Self::in_blocks(rows, 1)
    }

    /// A zero matrix of `rows` ≥ 3`B` rows in blocks of `block`, which no segment cuts.
    ///
    /// # Panics
    /// If there are fewer, no whole blocks of them, or `B` is 0.
    #[must_use]
    pub fn in_blocks(rows: usize, block: usize) -> Self {
        assert!(B > 0, "a matrix without bands is diagonal");
        assert!(rows >= 3 * B, "a cyclic band of half-width {B} needs {} rows", 3 * B);
        assert!(rows.is_multiple_of(block), "{rows} rows in blocks of {block}");
        let blocks = rows / block;
        let segments = (blocks / (2 * B).div_ceil(block)).clamp(1, LANES);
        let starts: Vec<usize> = (0..=segments).map(|segment| segment * blocks / segments * block).collect();
        let longest = blocks.div_ceil(segments) * block;
        let mut banded = Self {
            rows,
            block,
            segments,
            starts,
            factors: Factors::new(longest),
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

    /// Number of places in each segment.
    #[must_use]
    pub fn places(&self) -> usize {
        self.factors.rows()
    }

    /// Row at the first place of each segment, before that of the segment where unit rows stand there.
    #[must_use]
    pub fn first_rows(&self) -> [isize; LANES] {
        let first = |lane: usize| self.starts[lane] as isize - self.padding(lane) as isize;
        std::array::from_fn(|lane| if lane < self.segments { first(lane) } else { 0 })
    }

    /// Number of unit rows before the interior of a segment.
    fn padding(&self, segment: usize) -> usize {
        self.places() - (self.starts[segment + 1] - self.starts[segment])
    }

    /// Segment of a row, and its number in it.
    fn locate(&self, row: usize) -> (usize, usize) {
        let segment = ((row / self.block + 1) * self.segments - 1) / (self.rows / self.block);
        (segment, self.padding(segment) + row - self.starts[segment])
    }

    /// Sets every entry to zero, ready to be filled again.
    pub fn clear(&mut self) {
        self.factors.clear();
        for lane in 0..LANES {
            let unit_rows = if lane < self.segments { self.padding(lane) } else { self.places() };
            (0..unit_rows).for_each(|row| self.factors.from(row, 0)[0][lane] = 1.0);
        }
    }

    /// Sets the entry in `row` and column `row + offset` (cyclic), |`offset`| ≤ `B`.
    ///
    /// # Panics
    /// If there is no such row, or the offset is larger.
    pub fn set(&mut self, row: usize, offset: isize, value: f64) {
        let inside = row < self.rows && offset.unsigned_abs() <= B;
        assert!(inside, "offset {offset} in row {row} of {} with {B} bands on each side", self.rows);
        let column = (row as isize + offset).rem_euclid(self.rows as isize) as usize;
        let ((segment, r), (column_segment, c)) = (self.locate(row), self.locate(column));
        let factors = &mut self.factors;
        if segment == column_segment && c as isize - r as isize == offset {
            factors.from(r, offset)[0][segment] = value;
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
        if start < self.padding(segment) as isize || start as usize + values.len() > self.places() {
            for (k, value) in values.iter().enumerate() {
                self.set(row, first + k as isize, *value);
            }
            return;
        }
        for (entry, value) in self.factors.from(r, first).iter_mut().zip(values) {
            entry[segment] = *value;
        }
    }

    /// Sets consecutive entries of the rows at `place` in all segments, the first in the column `first` after the row, none beyond
    /// the band.
    pub fn set_rows(&mut self, place: usize, first: isize, values: &[Lane]) {
        let (start, longest, interior) = (place as isize + first, self.places(), self.factors.interior);
        if self.segments == LANES && start >= self.block as isize && start as usize + values.len() <= longest
        {
            return self.factors.from(place, first)[..values.len()].copy_from_slice(values);
        }
        for lane in 0..self.segments {
            let next = (lane + 1) % self.segments;
            let [padding, next_padding] = [lane, next].map(|lane| self.padding(lane));
            if place < padding {
                continue;
            }
            for (k, value) in values.iter().enumerate() {
                let column = start + k as isize;
                let entry = if column < padding as isize {
                    &mut self.factors.right[place][(column + B as isize) as usize - padding][lane]
                } else if column as usize >= longest {
                    &mut self.factors.bottom[column as usize - longest + next_padding][place - interior][next]
                } else {
                    &mut self.factors.from(place, first + k as isize)[0][lane]
                };
                *entry = value[lane];
            }
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
                for j in 0..B {
                    let inside = &mut factors.from(row, j as isize - i as isize)[0][lane];
                    // Left of the diagonal are the columns of the interior alone.
                    let entry = if j < i { std::mem::take(inside) } else { *inside };
                    self.separators.add(here + i, here + j, entry);
                    self.separators.add(here + i, before + j, factors.right[row][j][lane]);
                    self.separators.add(before + j, here + i, factors.bottom[row][j][lane]);
                    self.separators.add(before + i, before + j, factors.corner[i][j][lane]);
                }
            }
        }
    }

    /// The values in `x` of the `part`-th rows of the blocks of a segment, and the place in `work` of the first.
    fn part(&self, lane: usize, part: usize) -> (Range<usize>, usize) {
        let first = part * (self.rows / self.block);
        let [start, end] = [lane, lane + 1].map(|segment| first + self.starts[segment] / self.block);
        (start..end, B + self.padding(lane) + part)
    }

    /// Overwrites the right-hand side `x` by the solution. In blocks, `x` holds the first rows of all blocks, then their second
    /// rows, and so on.
    ///
    /// # Panics
    /// If there is not one value per row.
    pub fn solve(&mut self, x: &mut [f64]) {
        assert_eq!(x.len(), self.rows, "length of the right-hand side");
        let (interior, segments) = (self.factors.interior, self.segments);
        for (lane, part) in (0..segments).flat_map(|lane| (0..self.block).map(move |part| (lane, part))) {
            let (values, first) = self.part(lane, part);
            for (row, value) in self.work[first..].iter_mut().step_by(self.block).zip(&x[values]) {
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
        for (lane, part) in (0..segments).flat_map(|lane| (0..self.block).map(move |part| (lane, part))) {
            let (values, first) = self.part(lane, part);
            for (value, row) in x[values].iter_mut().zip(self.work[first..].iter().step_by(self.block)) {
                *value = row[lane];
            }
        }
    }
}
