//! LU factorisation of cyclic banded matrices, in segments that are eliminated side by side.
//!
//! The ring of unknowns is cut into segments; the last `B` unknowns of each separate it from the next. All
//! segments are eliminated at once, one in each lane of the vector registers, without pivoting (their leading
//! blocks are matrices with Dirichlet ends); what is left couples the separators, a small dense matrix, which is
//! pivoted. See `THEORY.md`, eq. (O2).

mod entries;

use std::ops::Range;

use super::band_factors::{Factors, LANES, Lane, eliminate, substitute_backward, substitute_forward};
use super::factorisation_error::FactorisationError;
use super::small_lu::SmallLu;

/// A cyclic matrix with `B` bands on each side of the diagonal: A x = b in `O(rows)`. See `THEORY.md`, eq. (O2).
///
/// It is filled in, factorised in place, and solves from then on, until [`CyclicBanded::clear`] makes room for other entries.
///
/// Rows have a place within their segment: first unit rows that make all segments equally long, then the interior,
/// then the `B` rows of the separator.
///
/// # No pivoting
/// The elimination takes the pivots where they stand, but for the last few unknowns of each segment. It is stable for matrices that are
/// diagonally dominant or symmetric and positive definite (nearly, if not exactly). Others may have a pivot of zero though they are
/// invertible, which [`CyclicBanded::factorise`] tells, or a small one, by whose inverse the rounding of the solution grows unseen:
/// compare A x with b there.
///
/// ```
/// use flow_core::operators::CyclicBanded;
///
/// // 4x_i + x_{i−1} + x_{i+1} = 6 on a ring: x = 1.
/// let mut matrix = CyclicBanded::<1>::new(32);
/// (0..32).for_each(|row| matrix.set_row(row, -1, &[1.0, 4.0, 1.0]));
/// matrix.factorise()?;
/// let mut x = [6.0; 32];
/// matrix.solve(&mut x);
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-14));
/// # Ok::<(), flow_core::operators::FactorisationError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CyclicBanded<const B: usize> {
    rows: usize,
    holds: Holds,
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

/// What is in the room of the entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Holds {
    Entries,
    Factors,
    /// What a failed factorisation left behind.
    Nothing,
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
            holds: Holds::Entries,
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

    /// Factorises the matrix that was filled in, in its place.
    ///
    /// # Errors
    /// [`FactorisationError`] at the first pivot that is zero or not finite; nothing is held then.
    /// # Panics
    /// If it was factorised and not cleared since.
    pub fn factorise(&mut self) -> Result<(), FactorisationError> {
        self.check_open();
        self.holds = Holds::Nothing;
        if let Some((r, lane, pivot)) = eliminate(&mut self.factors) {
            return Err(FactorisationError { row: self.starts[lane] + r - self.padding(lane), pivot });
        }
        self.couple_separators();
        self.separators.factorise().map_err(|FactorisationError { row, pivot }| {
            let end = self.starts[row / B + 1];
            FactorisationError { row: end - B + row % B, pivot }
        })?;
        self.holds = Holds::Factors;
        Ok(())
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
    /// If there is not one value per row, or no factorisation is held: before [`CyclicBanded::factorise`], and after one that failed.
    pub fn solve(&mut self, x: &mut [f64]) {
        assert!(self.holds == Holds::Factors, "the matrix is not factorised, or that failed");
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
