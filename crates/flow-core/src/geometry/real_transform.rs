//! The discrete Fourier transform of real values by a complex one: of half the length if it is even.
//!
//! With zⱼ = x₂ⱼ + i x₂ⱼ₊₁ and its transform Z of length M = N/2, Xₖ = ½(Zₖ + conj Zₘ₋ₖ) + ½uₖ(Zₖ − conj Zₘ₋ₖ) with
//! uₖ = −i e^{−2πik/N} and m = M; the inverse has the conjugates of uₖ. See `THEORY.md`, eq. (D1).

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use std::cell::RefCell;
use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

use bytemuck::{cast_slice, cast_slice_mut};
use multiversion::multiversion;
use rustfft::{Fft, FftPlanner};

use super::kept::Kept;
use rustfft::num_complex::Complex64;

/// Plans and scratch for one number of values.
#[derive(Clone)]
pub struct RealTransform {
    values: usize,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// uₖ for k ≤ M/2; empty if the number of values is odd.
    turns: Arc<[Complex64]>,
    work: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl fmt::Debug for RealTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "RealTransform {{ values: {} }}", self.values)
    }
}

thread_local! {
    /// A run that changes its nodes comes back to the same few numbers, and each of its operators transforms; a plan takes
    /// longer than a step.
    static PLANS: RefCell<Kept<RealTransform>> = RefCell::default();
}

impl RealTransform {
    /// A transform of `values` ≥ 2 values.
    #[must_use]
    pub fn new(values: usize) -> Self {
        PLANS.with_borrow_mut(|plans| plans.of(values, || Self::planned(values)))
    }

    fn planned(values: usize) -> Self {
        let even = values.is_multiple_of(2);
        let length = if even { values / 2 } else { values };
        let mut planner = FftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(length), planner.plan_fft_inverse(length));
        let scratch = if even {
            forward.get_immutable_scratch_len().max(inverse.get_outofplace_scratch_len())
        } else {
            forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len())
        };
        let turn = |k: usize| {
            let (sine, cosine) = (TAU * k as f64 / values as f64).sin_cos();
            Complex64::new(-sine, -cosine)
        };
        let zero = Complex64::default();
        Self {
            values,
            forward,
            inverse,
            turns: if even { (0..=length / 2).map(turn).collect() } else { Arc::new([]) },
            work: vec![zero; length],
            scratch: vec![zero; scratch],
        }
    }

    /// Panics unless there are as many values and coefficients as the transform is for.
    #[track_caller]
    fn check(&self, values: &[f64], spectrum: &[Complex64]) {
        let lengths = (self.values, self.values / 2 + 1);
        assert_eq!(
            (values.len(), spectrum.len()),
            lengths,
            "nodal values and Fourier coefficients of the grid"
        );
    }

    /// `spectrum[k]` = Σ `values[j]` e^{−2πijk/N}/N for k ≤ N/2.
    pub fn forward(&mut self, values: &[f64], spectrum: &mut [Complex64]) {
        self.check(values, spectrum);
        let scale = 1.0 / self.values as f64;
        if self.turns.is_empty() {
            for (work, value) in self.work.iter_mut().zip(values) {
                *work = Complex64::new(*value, 0.0);
            }
            self.forward.process_with_scratch(&mut self.work, &mut self.scratch);
            for (coefficient, work) in spectrum.iter_mut().zip(&self.work) {
                *coefficient = work * scale;
            }
        } else {
            let pairs = cast_slice(values);
            self.forward.process_immutable_with_scratch(pairs, &mut self.work, &mut self.scratch);
            untangle(&self.work, &self.turns, scale, spectrum);
        }
    }

    /// The real values with the Fourier coefficients `spectrum`; the imaginary parts of the mean and of the
    /// sawtooth, which real values do not have, are ignored.
    pub fn inverse(&mut self, spectrum: &[Complex64], values: &mut [f64]) {
        self.check(values, spectrum);
        if self.turns.is_empty() {
            let last = self.values;
            self.work[0] = Complex64::new(spectrum[0].re, 0.0);
            for (k, coefficient) in spectrum.iter().enumerate().skip(1) {
                self.work[k] = *coefficient;
                self.work[last - k] = coefficient.conj();
            }
            self.inverse.process_with_scratch(&mut self.work, &mut self.scratch);
            for (value, work) in values.iter_mut().zip(&self.work) {
                *value = work.re;
            }
        } else {
            tangle(spectrum, &self.turns, &mut self.work);
            let pairs = cast_slice_mut(values);
            self.inverse.process_outofplace_with_scratch(&mut self.work, pairs, &mut self.scratch);
        }
    }
}

/// Modes combined at once, as real numbers and as complex ones.
const LANES: usize = 8;
const WIDTH: usize = LANES / 2;
type Chunk = [f64; LANES];

/// (½(a + b̄) + ½u(a − b̄), conj(½(a + b̄) − ½u(a − b̄))) times twice `half`.
#[inline(always)]
fn butterfly(a: Complex64, b: Complex64, u: Complex64, half: f64) -> [Complex64; 2] {
    let (sum_re, sum_im) = (half * (a.re + b.re), half * (a.im - b.im));
    let (difference_re, difference_im) = (half * (a.re - b.re), half * (a.im + b.im));
    let turned_re = u.re * difference_re - u.im * difference_im;
    let turned_im = u.re * difference_im + u.im * difference_re;
    [
        Complex64::new(sum_re + turned_re, sum_im + turned_im),
        Complex64::new(sum_re - turned_re, turned_im - sum_im),
    ]
}

/// Butterflies of `from[k]` and `from[length − k]` into `to` for 1 ≤ k ≤ `length`/2, with `turns[k]` or, if
/// `INVERSE`, its conjugate.
#[inline(always)]
fn butterflies<const INVERSE: bool>(
    from: &[Complex64],
    to: &mut [Complex64],
    length: usize,
    turns: &[Complex64],
    half: f64,
) {
    let middle = length / 2;
    // The modes that are not their own mirror image.
    let pairs = length - middle - 1;
    let (low_to, high_to) = to.split_at_mut(middle + 1);
    let low_to = &mut low_to[1..=pairs];
    let [low, high, turn] = [&from[1..=pairs], &from[middle + 1..length], &turns[1..=pairs]];
    // Whole chunks below the middle, and their mirror images, the last first.
    let (lows, _) = cast_slice(low).as_chunks::<LANES>();
    let (_, highs) = cast_slice(high).as_rchunks::<LANES>();
    let (us, _) = cast_slice(turn).as_chunks::<LANES>();
    let (low_targets, _) = cast_slice_mut(low_to).as_chunks_mut::<LANES>();
    let (_, high_targets) = cast_slice_mut(&mut high_to[..pairs]).as_rchunks_mut::<LANES>();
    let mirrored = highs.iter().zip(high_targets).rev();
    for (((low, low_target), u), (high, high_target)) in lows.iter().zip(low_targets).zip(us).zip(mirrored) {
        [*low_target, *high_target] = butterfly_of_chunks::<INVERSE>(low, high, u, half);
    }
    let mut done = lows.len() * WIDTH;
    // What is left of them by one more chunk, which does some of the last one again.
    if done < pairs
        && let (Some(low), Some(high), Some(u)) =
            (cast_slice(low).last_chunk(), cast_slice(high).first_chunk(), cast_slice(turn).last_chunk())
        && let Some(low_target) = cast_slice_mut(low_to).last_chunk_mut()
        && let Some(high_target) = cast_slice_mut(high_to).first_chunk_mut()
    {
        [*low_target, *high_target] = butterfly_of_chunks::<INVERSE>(low, high, u, half);
        done = pairs;
    }
    for k in 1 + done..=middle {
        let turn = if INVERSE { turns[k].conj() } else { turns[k] };
        let [low, high] = butterfly(from[k], from[length - k], turn, half);
        to[k] = low;
        to[length - k] = high;
    }
}

/// As [`butterfly`] for the modes of a chunk and those of its mirror image: operations on whole registers, with
/// real and imaginary parts side by side as they lie in memory.
#[inline(always)]
fn butterfly_of_chunks<const INVERSE: bool>(low: &Chunk, high: &Chunk, u: &Chunk, half: f64) -> [Chunk; 2] {
    let sign = |l: usize| if l.is_multiple_of(2) == INVERSE { 1.0 } else { -1.0 };
    let mirror: Chunk = std::array::from_fn(|l| high[LANES - 2 + 2 * (l % 2) - l]);
    let conjugate: Chunk = std::array::from_fn(|l| if l % 2 == 0 { mirror[l] } else { -mirror[l] });
    let sum: Chunk = std::array::from_fn(|l| half * (low[l] + conjugate[l]));
    let difference: Chunk = std::array::from_fn(|l| half * (low[l] - conjugate[l]));
    let swapped: Chunk = std::array::from_fn(|l| difference[l ^ 1]);
    let re: Chunk = std::array::from_fn(|l| u[l & !1]);
    let im: Chunk = std::array::from_fn(|l| sign(l) * u[l | 1]);
    let turned: Chunk = std::array::from_fn(|l| re[l] * difference[l] + im[l] * swapped[l]);
    let below: Chunk =
        std::array::from_fn(|l| if l % 2 == 0 { sum[l] - turned[l] } else { turned[l] - sum[l] });
    [std::array::from_fn(|l| sum[l] + turned[l]), std::array::from_fn(|l| below[LANES - 2 + 2 * (l % 2) - l])]
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn untangle(half_spectrum: &[Complex64], turns: &[Complex64], scale: f64, spectrum: &mut [Complex64]) {
    let length = half_spectrum.len();
    let Complex64 { re, im } = half_spectrum[0];
    spectrum[0] = Complex64::new(scale * (re + im), 0.0);
    spectrum[length] = Complex64::new(scale * (re - im), 0.0);
    butterflies::<false>(half_spectrum, spectrum, length, turns, 0.5 * scale);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn tangle(spectrum: &[Complex64], turns: &[Complex64], half_spectrum: &mut [Complex64]) {
    let length = half_spectrum.len();
    let (mean, sawtooth) = (spectrum[0].re, spectrum[length].re);
    half_spectrum[0] = Complex64::new(mean + sawtooth, mean - sawtooth);
    butterflies::<true>(spectrum, half_spectrum, length, turns, 1.0);
}
