//! Sums over past values and moments, each in one pass over the entries.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

use super::MOST_MOMENTS;
use super::moments::{Block, LANES};
use super::polynomials::Coefficients;

/// Entries of a block of moments, which belong to pairs of them.
const ENTRIES: usize = 2 * LANES;
type Entries = [f64; ENTRIES];

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

/// y = e^z y₀ + h Σⱼ Σᵢ pⱼᵢ mᵢ Nⱼ with the coefficients p of `basis`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn extrapolate(
    h: f64,
    basis: &[Coefficients],
    blocks: &[Block],
    (start, rests): (&[f64], &[Vec<f64>]),
    y: &mut [f64],
) {
    for (index, block) in blocks.iter().enumerate() {
        let first = index * ENTRIES;
        let (decay, start) = (twice(&block.decay), load(start, first));
        let mut sum: Entries = std::array::from_fn(|k| decay[k] * start[k]);
        for (polynomial, rest) in basis.iter().zip(rests) {
            let (weight, rest) = (twice(&integral(h, &polynomial[..basis.len()], block)), load(rest, first));
            for k in 0..ENTRIES {
                sum[k] += weight[k] * rest[k];
            }
        }
        store(&sum, y, first);
    }
}

/// What each of the `corrections` changes in a step of size h, with the new value `new` of N and the past ones `rests`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn correct(
    h: f64,
    corrections: &[Correction],
    blocks: &[Block],
    (new, rests): (&[f64], &[Vec<f64>]),
    changes: &mut [Vec<f64>],
) {
    let points = corrections.iter().map(|correction| correction.points).max().unwrap_or(0);
    let mut past = [[0.0; ENTRIES]; MOST_MOMENTS];
    for (index, block) in blocks.iter().enumerate() {
        let first = index * ENTRIES;
        let new = load(new, first);
        for (past, rest) in past[..points].iter_mut().zip(rests) {
            *past = load(rest, first);
        }
        for (correction, change) in corrections.iter().zip(&mut *changes) {
            let mut missed = new;
            for (weight, past) in correction.weights[..correction.points].iter().zip(&past) {
                for k in 0..ENTRIES {
                    missed[k] -= weight * past[k];
                }
            }
            let factor = twice(&integral(h, &correction.polynomial[..correction.terms], block));
            for k in 0..ENTRIES {
                missed[k] *= factor[k];
            }
            store(&missed, change, first);
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

/// The entries from `first` on, zero beyond the last.
#[inline(always)]
fn load(vector: &[f64], first: usize) -> Entries {
    let rest = &vector[first..];
    if let Some(entries) = rest.first_chunk::<ENTRIES>() {
        return *entries;
    }
    let mut entries = [0.0; ENTRIES];
    entries[..rest.len()].copy_from_slice(rest);
    entries
}

/// Writes them back.
#[inline(always)]
fn store(entries: &Entries, vector: &mut [f64], first: usize) {
    let rest = &mut vector[first..];
    if let Some(target) = rest.first_chunk_mut::<ENTRIES>() {
        *target = *entries;
    } else {
        rest.copy_from_slice(&entries[..rest.len()]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::moments::{Moments, moments_at};
    use super::*;

    /// Values that differ from entry to entry, on a number of entries that fills no block.
    fn vector(seed: f64) -> Vec<f64> {
        (0..2 * ENTRIES + 7).map(|entry| (seed + entry as f64).sin()).collect()
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
        extrapolate(h, &basis, moments.blocks(), (&start, &rests), &mut y);
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
