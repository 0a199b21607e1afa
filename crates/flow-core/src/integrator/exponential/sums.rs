//! Sums over past values and moments, each in one pass over the entries.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

use super::MOST_MOMENTS;
use super::polynomials::Coefficients;

/// Entries in registers at a time.
const LANES: usize = 8;
type Lanes = [f64; LANES];

/// out = h Σ aᵢ mᵢ v with the coefficients a of `polynomial`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn integrate(h: f64, polynomial: &[f64], moments: &[Vec<f64>], v: &[f64], out: &mut [f64]) {
    for (block, out) in out.chunks_mut(LANES).enumerate() {
        let first = block * LANES;
        let mut sum = [0.0; LANES];
        for (coefficient, moment) in polynomial.iter().zip(moments) {
            add_scaled(&mut sum, h * coefficient, &load(moment, first));
        }
        let v = load(v, first);
        for (k, out) in out.iter_mut().enumerate() {
            *out = sum[k] * v[k];
        }
    }
}

/// y = e^z y₀ + h Σᵢ mᵢ Σⱼ pⱼᵢ Nⱼ with the coefficients p of `basis`, and `at_one` = Σᵢⱼ pⱼᵢ Nⱼ.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn extrapolate(
    h: f64,
    basis: &[Coefficients],
    (decay, moments): (&[f64], &[Vec<f64>]),
    (start, rests): (&[f64], &[Vec<f64>]),
    y: &mut [f64],
    at_one: &mut [f64],
) {
    let points = basis.len();
    let mut values = [[0.0; LANES]; MOST_MOMENTS];
    for first in (0..y.len()).step_by(LANES) {
        for (value, rest) in values[..points].iter_mut().zip(rests) {
            *value = load(rest, first);
        }
        let (mut sum, mut driven) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..points {
            let mut coefficient = [0.0; LANES];
            for (value, polynomial) in values[..points].iter().zip(basis) {
                add_scaled(&mut coefficient, polynomial[i], value);
            }
            let moment = load(&moments[i], first);
            for k in 0..LANES {
                driven[k] += moment[k] * coefficient[k];
                sum[k] += coefficient[k];
            }
        }
        let (start, decay) = (load(start, first), load(decay, first));
        let end = y.len().min(first + LANES);
        let targets = y[first..end].iter_mut().zip(&mut at_one[first..end]);
        for (k, (y, at_one)) in targets.enumerate() {
            *y = decay[k] * start[k] + h * driven[k];
            *at_one = sum[k];
        }
    }
}

/// The entries from `first` on, zero beyond the last.
#[inline(always)]
fn load(vector: &[f64], first: usize) -> Lanes {
    let rest = &vector[first..];
    if let Some(lanes) = rest.first_chunk::<LANES>() {
        return *lanes;
    }
    let mut lanes = [0.0; LANES];
    lanes[..rest.len()].copy_from_slice(rest);
    lanes
}

#[inline(always)]
fn add_scaled(sum: &mut Lanes, factor: f64, x: &Lanes) {
    for k in 0..LANES {
        sum[k] += factor * x[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vectors::combine;

    /// Values that differ from entry to entry, on a number of entries that is no multiple of the lanes.
    fn vector(seed: f64) -> Vec<f64> {
        (0..2 * LANES + 3).map(|entry| (seed + entry as f64).sin()).collect()
    }

    #[test]
    fn sums_are_those_entry_by_entry() {
        let (rests, moments) =
            ([vector(1.0), vector(2.0), vector(3.0)], [vector(4.0), vector(5.0), vector(6.0)]);
        let (start, decay, h) = (vector(7.0), vector(8.0), 0.3);
        let basis: [Coefficients; 3] =
            std::array::from_fn(|j| std::array::from_fn(|i| (1 + i + 3 * j) as f64 - 4.5));
        let [mut y, mut at_one, mut sum, mut integral] = std::array::from_fn(|_| vector(0.0));
        extrapolate(h, &basis, (&decay, &moments), (&start, &rests), &mut y, &mut at_one);
        combine(&basis[1][..3], &rests, &mut sum);
        integrate(h, &basis[2][..3], &moments, &start, &mut integral);
        for e in 0..start.len() {
            let coefficient = |i: usize| (0..3).map(|j| basis[j][i] * rests[j][e]).sum::<f64>();
            let driven =
                |weight: &dyn Fn(usize) -> f64| (0..3).map(|i| weight(i) * moments[i][e]).sum::<f64>();
            assert!((y[e] - decay[e] * start[e] - h * driven(&coefficient)).abs() < 1e-14);
            assert!((at_one[e] - (0..3).map(coefficient).sum::<f64>()).abs() < 1e-13);
            assert!((sum[e] - (0..3).map(|j| basis[1][j] * rests[j][e]).sum::<f64>()).abs() < 1e-13);
            assert!((integral[e] - h * start[e] * driven(&|i| basis[2][i])).abs() < 1e-13);
        }
    }
}
