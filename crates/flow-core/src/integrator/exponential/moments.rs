//! Moments of the exponential, mᵢ(z) = ∫₀¹ e^{(1−θ)z} θⁱ dθ = i! φᵢ₊₁(z). See `THEORY.md`, eq. (I10).

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loop

use multiversion::multiversion;

use super::orders::MOST_MOMENTS;
use crate::expression::vector_math::exp;

/// Below this |z| the recursion mᵢ = (i mᵢ₋₁ − 1)/z loses digits, and m of the highest index is summed.
const SMALL: f64 = 2.0;
/// Terms of that sum, to rounding.
const TERMS: usize = 22;
/// 1/k.
const INVERSES: [f64; MOST_MOMENTS + TERMS] = {
    let mut inverses = [f64::INFINITY; MOST_MOMENTS + TERMS];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = 1.0 / k as f64;
        k += 1;
    }
    inverses
};
/// Pairs of entries whose moments are computed at a time.
pub const LANES: usize = 8;

/// e^z, and m₀ … mₙ₋₁ at each z, n the length of `moments`.
#[inline(always)]
fn moments_of(z: [f64; LANES], moments: &mut [[f64; LANES]]) -> [f64; LANES] {
    let mut decay = [0.0; LANES];
    (0..LANES).for_each(|k| decay[k] = exp(z[k]));
    if z.iter().all(|z| z.abs() >= SMALL) {
        by_recursion(z, decay, moments);
    } else if z.iter().all(|z| z.abs() < SMALL) {
        by_series(z, moments);
    } else {
        let mut others = [[0.0; LANES]; MOST_MOMENTS];
        by_series(z.map(|z| z.clamp(-SMALL, SMALL)), moments);
        by_recursion(
            z.map(|z| if z.abs() < SMALL { -SMALL } else { z }),
            decay,
            &mut others[..moments.len()],
        );
        for (moment, other) in moments.iter_mut().zip(&others) {
            for k in 0..LANES {
                moment[k] = if z[k].abs() < SMALL { moment[k] } else { other[k] };
            }
        }
    }
    decay
}

#[inline(always)]
fn by_recursion(z: [f64; LANES], decay: [f64; LANES], moments: &mut [[f64; LANES]]) {
    let inverse = z.map(|z| 1.0 / z);
    let mut last: [f64; LANES] = std::array::from_fn(|k| (decay[k] - 1.0) * inverse[k]);
    for (i, moment) in moments.iter_mut().enumerate() {
        if i > 0 {
            last = std::array::from_fn(|k| (i as f64 * last[k] - 1.0) * inverse[k]);
        }
        *moment = last;
    }
}

/// mᵢ = Σ zᵏ i!/(i + 1 + k)! for the highest i, summed from its end; the others by mᵢ₋₁ = (z mᵢ + 1)/i.
#[inline(always)]
fn by_series(z: [f64; LANES], moments: &mut [[f64; LANES]]) {
    let Some(highest) = moments.len().checked_sub(1) else { return };
    let mut sum = [1.0; LANES];
    for inverse in INVERSES[highest + 2..][..TERMS - 1].iter().rev() {
        sum = std::array::from_fn(|lane| 1.0 + sum[lane] * z[lane] * inverse);
    }
    moments[highest] = sum.map(|sum| sum * INVERSES[highest + 1]);
    for i in (1..=highest).rev() {
        moments[i - 1] = std::array::from_fn(|lane| (z[lane] * moments[i][lane] + 1.0) * INVERSES[i]);
    }
}

/// The functions of [`LANES`] pairs of entries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Block {
    /// e^z.
    pub decay: [f64; LANES],
    /// mᵢ by their index.
    pub moments: [[f64; LANES]; MOST_MOMENTS],
}

/// The first `count` moments at z = `size` × rate for each of the `rates`, of which each stands twice, for a real and an imaginary
/// part, but for the last one, which is alone.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn fill(size: f64, rates: &[f64], count: usize, blocks: &mut [Block]) {
    for (block, target) in blocks.iter_mut().enumerate() {
        let rate = |k: usize| rates[(2 * (block * LANES + k)).min(rates.len() - 1)];
        target.decay = moments_of(std::array::from_fn(|k| size * rate(k)), &mut target.moments[..count]);
    }
}

/// The moments of all entries for one step size.
#[derive(Clone, Debug)]
pub struct Moments {
    /// Step size, and how many of the moments are known.
    size: f64,
    known: usize,
    blocks: Vec<Block>,
}

impl Moments {
    /// Room for `entries` entries.
    pub fn new(entries: usize) -> Self {
        let blocks = entries.div_ceil(2).div_ceil(LANES);
        Self { size: 0.0, known: 0, blocks: vec![Block::default(); blocks] }
    }

    /// The rates have changed.
    pub fn forget(&mut self) {
        self.known = 0;
    }

    /// The first `count` moments at zₑ = `size` × rate of entry e; the rates are those of a [`LinearPart`].
    ///
    /// [`LinearPart`]: crate::integrator::LinearPart
    pub fn set(&mut self, size: f64, rates: &[f64], count: usize) {
        if size.to_bits() == self.size.to_bits() && count <= self.known {
            return;
        }
        (self.size, self.known) = (size, count);
        fill(size, rates, count, &mut self.blocks);
    }

    /// By pairs of entries.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// e^z, and m₀ … mₙ₋₁ at one z, n the length of `moments`.
    pub fn moments_at(z: f64, moments: &mut [f64]) -> f64 {
        let mut lanes = [[0.0; LANES]; MOST_MOMENTS];
        let decay = moments_of([z; LANES], &mut lanes[..moments.len()]);
        moments.iter_mut().zip(&lanes).for_each(|(moment, lanes)| *moment = lanes[0]);
        decay[0]
    }

    #[test]
    fn each_entry_finds_the_moments_of_its_rate() {
        // Pairs in one block and a bit of the next, and one entry more.
        let mut rates: Vec<f64> = (0..2 * LANES + 6).map(|entry| -((entry / 2) as f64)).collect();
        rates.push(0.7);
        let mut moments = Moments::new(rates.len());
        moments.set(0.5, &rates, 4);
        for (entry, rate) in rates.iter().enumerate() {
            let (block, lane) = (entry / 2 / LANES, entry / 2 % LANES);
            let mut alone = [0.0; 4];
            let decay = moments_at(0.5 * rate, &mut alone);
            assert_eq!(moments.blocks()[block].decay[lane], decay);
            assert_eq!([0, 1, 2, 3].map(|i| moments.blocks()[block].moments[i][lane]), alone);
        }
    }

    /// By Gauss–Legendre quadrature on many pieces.
    fn reference(z: f64, i: i32) -> f64 {
        let pieces = 40_000;
        let at = |x: f64| ((1.0 - x) * z).exp() * x.powi(i);
        let shift = 0.5 / 3.0_f64.sqrt();
        let pair = |k: i32| {
            let middle = (f64::from(k) + 0.5) / f64::from(pieces);
            let step = shift / f64::from(pieces);
            0.5 * (at(middle - step) + at(middle + step)) / f64::from(pieces)
        };
        (0..pieces).map(pair).sum()
    }

    #[test]
    fn moments_are_the_integrals() {
        for z in [-300.0, -30.0, -2.0, -1.0, -0.999, -0.1, -1e-9, 0.0, 0.5, 3.0] {
            let mut moments = [0.0; MOST_MOMENTS];
            let decay = moments_at(z, &mut moments);
            assert!((decay / z.exp() - 1.0).abs() < 1e-15);
            for (i, moment) in moments.iter().enumerate() {
                let exact = reference(z, i as i32);
                assert!(
                    (moment - exact).abs() < 1e-9 * exact.abs().max(1e-3),
                    "m{i}({z}) = {moment} ≠ {exact}"
                );
            }
        }
    }

    #[test]
    fn the_branches_meet() {
        let (mut inside, mut outside) = ([0.0; MOST_MOMENTS], [0.0; MOST_MOMENTS]);
        moments_at(-SMALL * (1.0 - 1e-15), &mut inside);
        moments_at(-SMALL, &mut outside);
        for (inside, outside) in inside.iter().zip(&outside) {
            assert!((inside - outside).abs() < 1e-11, "{inside} ≠ {outside}");
        }
    }
}
