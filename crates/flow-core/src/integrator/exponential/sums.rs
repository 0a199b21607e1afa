//! Sums over past values and moments, each in one pass over the entries.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

use super::blocked::{Blocked, ENTRIES, Entries};
use super::moments::{Block, LANES};
use super::orders::MOST_MOMENTS;
use super::polynomials::Coefficients;

/// What a new value of N changes: its difference from the past values with `weights`, times a polynomial.
#[derive(Clone, Copy, Debug)]
pub struct Correction {
    /// Past values that count, and their weights.
    pub points: usize,
    pub weights: [f64; MOST_MOMENTS],
    /// Coefficients that count, and these.
    pub terms: usize,
    pub polynomial: Coefficients,
}

/// y = e^z y₀ + h Σⱼ Σᵢ pⱼᵢ mᵢ Nⱼ with as many of the coefficients p of `basis` as it says.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn extrapolate(
    h: f64,
    (basis, terms): (&[Coefficients], usize),
    blocks: &[Block],
    (start, rests): (&Blocked, &[Blocked]),
    y: &mut Blocked,
) {
    let past = Past::of(rests, basis.len());
    for ((index, block), (start, y)) in
        blocks.iter().enumerate().zip(start.blocks().iter().zip(y.blocks_mut()))
    {
        let decay = twice(&block.decay);
        let mut sum: Entries = std::array::from_fn(|k| decay[k] * start[k]);
        for (polynomial, past) in basis.iter().zip(past.vectors()) {
            let (weight, past) = (twice(&integral(h, &polynomial[..terms], block)), &past[index]);
            for k in 0..ENTRIES {
                sum[k] += weight[k] * past[k];
            }
        }
        *y = sum;
    }
}

/// What each of the `corrections` changes in a step of size h, with the new value `new` of N and the past ones `rests`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn correct(
    h: f64,
    corrections: &[Correction],
    blocks: &[Block],
    (new, rests): (&Blocked, &[Blocked]),
    changes: &mut [Blocked],
) {
    for (correction, change) in corrections.iter().zip(changes) {
        let (weights, polynomial) =
            (&correction.weights[..correction.points], &correction.polynomial[..correction.terms]);
        let past = Past::of(rests, correction.points);
        for ((index, block), (new, change)) in
            blocks.iter().enumerate().zip(new.blocks().iter().zip(change.blocks_mut()))
        {
            let mut missed = *new;
            for (weight, past) in weights.iter().zip(past.vectors()) {
                let past = &past[index];
                for k in 0..ENTRIES {
                    missed[k] -= weight * past[k];
                }
            }
            let factor = twice(&integral(h, polynomial, block));
            for k in 0..ENTRIES {
                missed[k] *= factor[k];
            }
            *change = missed;
        }
    }
}

/// h Σ aᵢ mᵢ with the coefficients a.
#[inline(always)]
fn integral(h: f64, coefficients: &[f64], block: &Block) -> [f64; LANES] {
    let mut sum = [0.0; LANES];
    for (coefficient, moment) in coefficients.iter().zip(&block.moments) {
        for k in 0..LANES {
            sum[k] += coefficient * moment[k];
        }
    }
    sum.map(|sum| h * sum)
}

/// Each value for both entries of its pair.
#[inline(always)]
fn twice(values: &[f64; LANES]) -> Entries {
    std::array::from_fn(|k| values[k / 2])
}

/// Past values by blocks of entries. That their number is not known to the compiler keeps it from turning the loops inside out,
/// with gathers and scatters over the blocks.
struct Past<'a> {
    points: usize,
    vectors: [&'a [Entries]; MOST_MOMENTS],
}

impl<'a> Past<'a> {
    #[inline(always)]
    fn of(rests: &'a [Blocked], points: usize) -> Self {
        let mut past = Self { points, vectors: [&[]; MOST_MOMENTS] };
        for (vector, rest) in past.vectors.iter_mut().zip(&rests[..points]) {
            *vector = rest.blocks();
        }
        past
    }

    #[inline(always)]
    fn vectors(&self) -> &[&'a [Entries]] {
        &self.vectors[..self.points]
    }
}

#[cfg(test)]
mod tests {
    use super::super::moments::{Moments, tests::moments_at};
    use super::*;

    /// Values that differ from entry to entry, on a number of entries that fills no block.
    fn vector(seed: f64) -> Blocked {
        let mut vector = Blocked::new(2 * ENTRIES + 7);
        vector.iter_mut().enumerate().for_each(|(entry, value)| *value = (seed + entry as f64).sin());
        vector
    }

    #[test]
    fn sums_are_those_entry_by_entry() {
        let (rests, h) = ([vector(1.0), vector(2.0), vector(3.0)], 0.3);
        let (start, new) = (vector(4.0), vector(5.0));
        let rates: Vec<f64> = (0..start.len()).map(|entry| -((entry / 2) as f64)).collect();
        let mut moments = Moments::new(rates.len());
        moments.set(h, &rates, 3);
        let basis: [Coefficients; 3] =
            std::array::from_fn(|j| std::array::from_fn(|i| (1 + i + 3 * j) as f64 - 4.5));
        let [mut y, first, second] = std::array::from_fn(|_| vector(0.0));
        extrapolate(h, (&basis, 3), moments.blocks(), (&start, &rests), &mut y);
        let correction =
            |points, terms| Correction { points, weights: basis[1], terms, polynomial: basis[2] };
        let mut changes = [first, second];
        let corrections = [correction(3, 2), correction(1, 3)];
        correct(h, &corrections, moments.blocks(), (&new, &rests), &mut changes);
        for e in 0..start.len() {
            let mut m = [0.0; 3];
            let decay = moments_at(h * rates[e], &mut m);
            let driven = |j: usize, terms: usize| (0..terms).map(|i| basis[j][i] * m[i]).sum::<f64>();
            let predicted = decay * start[e] + h * (0..3).map(|j| driven(j, 3) * rests[j][e]).sum::<f64>();
            assert!((y[e] - predicted).abs() < 1e-13);
            for (change, [points, terms]) in changes.iter().zip([[3, 2], [1, 3]]) {
                let missed = new[e] - (0..points).map(|j| basis[1][j] * rests[j][e]).sum::<f64>();
                assert!((change[e] - h * driven(2, terms) * missed).abs() < 1e-13);
            }
        }
    }
}
