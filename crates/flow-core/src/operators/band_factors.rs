//! The loops of the cyclic banded factorisation, over all segments at once (see `cyclic_banded`).

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

/// Segments eliminated at once: one register of the widest kind.
pub const LANES: usize = 8;

/// One value for each segment.
pub type Lane = [f64; LANES];

/// The matrix by segments; factorised in place.
#[derive(Clone, Debug)]
pub struct Factors<const B: usize> {
    /// Rows of a segment before its separator.
    pub interior: usize,
    /// The entries of each row within its segment, from `B` columns before the diagonal to `B` after it; becomes L, the inverse of
    /// U's diagonal, and U.
    band: Vec<Lane>,
    /// Entries in the columns of the separator before the segment.
    pub right: Vec<[Lane; B]>,
    /// Entries in the rows of the separator before the segment, by column.
    pub bottom: Vec<[Lane; B]>,
    /// What the elimination adds to the block of the separator before the segment.
    pub corner: [[Lane; B]; B],
}

impl<const B: usize> Factors<B> {
    const WIDTH: usize = 2 * B + 1;

    /// Zeros for segments of `rows` rows.
    pub fn new(rows: usize) -> Self {
        let zeros = vec![[[0.0; LANES]; B]; rows];
        Self {
            interior: rows - B,
            band: vec![[0.0; LANES]; rows * Self::WIDTH],
            right: zeros.clone(),
            bottom: zeros,
            corner: [[[0.0; LANES]; B]; B],
        }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.band.fill([0.0; LANES]);
        self.right.fill([[0.0; LANES]; B]);
        self.bottom.fill([[0.0; LANES]; B]);
        self.corner = [[[0.0; LANES]; B]; B];
    }

    /// Rows of a segment.
    pub fn rows(&self) -> usize {
        self.interior + B
    }

    /// The entries of `row` from the column `offset` after it on.
    pub fn from(&mut self, row: usize, offset: isize) -> &mut [Lane] {
        &mut self.band[row * Self::WIDTH..][..Self::WIDTH][(B as isize + offset) as usize..]
    }
}

/// a −= b c, lane by lane.
#[inline(always)]
fn subtract_product(a: &mut Lane, b: &Lane, c: &Lane) {
    for lane in 0..LANES {
        a[lane] -= b[lane] * c[lane];
    }
}

/// Entries before, on and after the diagonal of a row of the band.
#[inline(always)]
fn split<const B: usize>(row: &[Lane]) -> (&[Lane; B], &Lane, &[Lane; B]) {
    let (Some(before), Some(after)) = (row.first_chunk(), row.last_chunk()) else {
        unreachable!("rows have 2B + 1 entries");
    };
    (before, &row[B], after)
}

/// Eliminates the interiors; row, lane and value of the first bad pivot.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn eliminate<const B: usize>(factors: &mut Factors<B>) -> Option<(usize, usize, f64)> {
    let width = Factors::<B>::WIDTH;
    for r in 0..factors.interior {
        let (row, below) = factors.band[r * width..].split_at_mut(width);
        let (_, &pivot, &upper) = split::<B>(row);
        let inverse = pivot.map(|value| 1.0 / value);
        if let Some(lane) = inverse.iter().position(|value| !value.is_finite() || *value == 0.0) {
            return Some((r, lane, pivot[lane]));
        }
        row[B] = inverse;
        let right = factors.right[r];
        for (j, target) in below.chunks_exact_mut(width).take(B).enumerate() {
            // The columns r, and r + 1 … r + B.
            let entries = &mut target[B - 1 - j..];
            let mut factor = entries[0];
            for lane in 0..LANES {
                factor[lane] *= inverse[lane];
            }
            entries[0] = factor;
            for (entry, upper) in entries[1..].iter_mut().zip(&upper) {
                subtract_product(entry, &factor, upper);
            }
            for (entry, right) in factors.right[r + 1 + j].iter_mut().zip(&right) {
                subtract_product(entry, &factor, right);
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
pub fn substitute_forward<const B: usize>(factors: &Factors<B>, work: &mut [Lane]) -> [Lane; B] {
    let mut tail = [[0.0; LANES]; B];
    for (r, row) in factors.band.chunks_exact(Factors::<B>::WIDTH).enumerate() {
        let (lower, ..) = split::<B>(row);
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
pub fn substitute_backward<const B: usize>(factors: &Factors<B>, previous: &[Lane; B], work: &mut [Lane]) {
    let rows = factors.band.chunks_exact(Factors::<B>::WIDTH).enumerate();
    for (r, row) in rows.take(factors.interior).rev() {
        let (_, inverse, upper) = split::<B>(row);
        let mut sum = work[B + r];
        for (right, previous) in factors.right[r].iter().zip(previous) {
            subtract_product(&mut sum, right, previous);
        }
        // The newest value last, so that a row waits for one product only.
        for k in (0..B).rev() {
            subtract_product(&mut sum, &upper[k], &work[B + r + 1 + k]);
        }
        for lane in 0..LANES {
            sum[lane] *= inverse[lane];
        }
        work[B + r] = sum;
    }
}
