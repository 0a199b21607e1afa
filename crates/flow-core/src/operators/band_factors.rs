//! The loops of the cyclic banded factorisation, over all segments at once (see `cyclic_banded.rs`).

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
    /// Entries left of the diagonal; becomes L.
    pub lower: Vec<[Lane; B]>,
    /// Becomes the inverse of U's diagonal.
    pub diagonal: Vec<Lane>,
    /// Entries right of the diagonal; becomes U.
    pub upper: Vec<[Lane; B]>,
    /// Entries in the columns of the separator before the segment.
    pub right: Vec<[Lane; B]>,
    /// Entries in the rows of the separator before the segment, by column.
    pub bottom: Vec<[Lane; B]>,
    /// What the elimination adds to the block of the separator before the segment.
    pub corner: [[Lane; B]; B],
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
pub fn eliminate<const B: usize>(factors: &mut Factors<B>) -> Option<(usize, usize, f64)> {
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
pub fn substitute_forward<const B: usize>(factors: &Factors<B>, work: &mut [Lane]) -> [Lane; B] {
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
pub fn substitute_backward<const B: usize>(factors: &Factors<B>, previous: &[Lane; B], work: &mut [Lane]) {
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
