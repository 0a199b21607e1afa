//! Loops over nodal values and over spectra, compiled for the widest vector registers at hand.
//!
//! The slices of a call have one length, which is for the caller to see to: nothing is checked here, and a loop ends with its
//! shortest slice.

use multiversion::multiversion;

use rustfft::num_complex::Complex64;

const LANES: usize = 8;

/// Sum in eight independent lanes.
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn sum(a: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = a.as_chunks::<LANES>();
    for a in chunks {
        for k in 0..LANES {
            lanes[k] += a[k];
        }
    }
    rest.iter().sum::<f64>() + total(lanes)
}

/// Sum of products, by lanes as [`sum`].
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let ((a_chunks, a_rest), (b_chunks, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for k in 0..LANES {
            lanes[k] += a[k] * b[k];
        }
    }
    a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>() + total(lanes)
}

/// Mean of the values.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    sum(values) / values.len() as f64
}

/// Mean of the products of three.
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn mean_of_triple_product(a: &[f64], b: &[f64], c: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a_chunks, a_rest) = a.as_chunks::<LANES>();
    let (b_chunks, b_rest) = b.as_chunks::<LANES>();
    let (c_chunks, c_rest) = c.as_chunks::<LANES>();
    for ((a, b), c) in a_chunks.iter().zip(b_chunks).zip(c_chunks) {
        for k in 0..LANES {
            lanes[k] += a[k] * b[k] * c[k];
        }
    }
    let rest = a_rest.iter().zip(b_rest).zip(c_rest);
    (rest.map(|((a, b), c)| a * b * c).sum::<f64>() + total(lanes)) / a.len() as f64
}

/// Mean of the products.
#[must_use]
pub fn mean_of_product(a: &[f64], b: &[f64]) -> f64 {
    dot(a, b) / a.len() as f64
}

/// Sum of `w` Re(ā b) over two spectra with real weights, by lanes as [`sum`].
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn weighted_dot(weights: &[f64], a: &[Complex64], b: &[Complex64]) -> f64 {
    const WIDTH: usize = LANES / 2;
    let mut lanes = [0.0; LANES];
    let (weight_chunks, weight_rest) = weights.as_chunks::<WIDTH>();
    let (a_chunks, a_rest) = a.as_chunks::<WIDTH>();
    let (b_chunks, b_rest) = b.as_chunks::<WIDTH>();
    for ((w, a), b) in weight_chunks.iter().zip(a_chunks).zip(b_chunks) {
        for k in 0..WIDTH {
            lanes[2 * k] += w[k] * (a[k].re * b[k].re);
            lanes[2 * k + 1] += w[k] * (a[k].im * b[k].im);
        }
    }
    let rest = weight_rest.iter().zip(a_rest).zip(b_rest);
    rest.map(|((w, a), b)| w * (a.re * b.re + a.im * b.im)).sum::<f64>() + total(lanes)
}

/// Sum of the moduli of a spectrum, by lanes as [`sum`].
#[must_use]
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn sum_of_moduli(a: &[Complex64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = a.as_chunks::<LANES>();
    for a in chunks {
        for k in 0..LANES {
            lanes[k] += a[k].norm_sqr().sqrt();
        }
    }
    rest.iter().map(|a| a.norm_sqr().sqrt()).sum::<f64>() + total(lanes)
}

// Inlined, its order of additions would lead the compiler to split the lanes into registers of two, shuffled in each turn.
#[inline(never)]
fn total(lanes: [f64; LANES]) -> f64 {
    ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]))
}

/// y += factor × x.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// y += factor × a × b, entry by entry.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn add_scaled_product(y: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    for ((y, a), b) in y.iter_mut().zip(a).zip(b) {
        *y += factor * (a * b);
    }
}

/// out = factor × x.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn scale_into(out: &mut [f64], factor: f64, x: &[f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = factor * x;
    }
}

/// out = Σ weight × vector, in one pass over the entries.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn combine(weights: &[f64], vectors: &[Vec<f64>], out: &mut [f64]) {
    let (chunks, rest) = out.as_chunks_mut::<LANES>();
    let whole = chunks.len() * LANES;
    for (chunk, out) in chunks.iter_mut().enumerate() {
        let mut sum = [0.0; LANES];
        for (weight, vector) in weights.iter().zip(vectors) {
            let vector = &vector[chunk * LANES..][..LANES];
            for k in 0..LANES {
                sum[k] += weight * vector[k];
            }
        }
        *out = sum;
    }
    for (entry, out) in rest.iter_mut().enumerate() {
        *out = 0.0;
        for (weight, vector) in weights.iter().zip(vectors) {
            *out += weight * vector[whole + entry];
        }
    }
}

/// out = x + shift.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn shift_into(out: &mut [f64], shift: f64, x: &[f64]) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = x + shift;
    }
}

/// xᵢ += start + slope × i.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn add_ramp(x: &mut [f64], start: f64, slope: f64) {
    // Counted in 32 bits: all processors convert several of these at once.
    for (i, x) in (0_u32..).zip(x) {
        *x += start + slope * f64::from(i as i32);
    }
}

/// x += shift.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn shift(x: &mut [f64], shift: f64) {
    for x in x {
        *x += shift;
    }
}

/// x ×= factor.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn scale(x: &mut [f64], factor: f64) {
    for x in x {
        *x *= factor;
    }
}

/// x ×= factors.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn multiply(x: &mut [f64], factors: &[f64]) {
    for (x, factor) in x.iter_mut().zip(factors) {
        *x *= factor;
    }
}

/// out = a × b.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn multiply_into(out: &mut [f64], a: &[f64], b: &[f64]) {
    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
        *out = a * b;
    }
}

/// out += a × b.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn add_product(out: &mut [f64], a: &[f64], b: &[f64]) {
    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
        *out += a * b;
    }
}

/// out = symbol × x for a complex symbol.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn apply_symbol(out: &mut [Complex64], x: &[Complex64], symbol: &[Complex64]) {
    for ((out, x), symbol) in out.iter_mut().zip(x).zip(symbol) {
        *out = x * symbol;
    }
}

/// out = factor × symbol × x for a real symbol.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn apply_real_symbol(out: &mut [Complex64], factor: f64, x: &[Complex64], symbol: &[f64]) {
    for ((out, x), symbol) in out.iter_mut().zip(x).zip(symbol) {
        *out = x * (factor * symbol);
    }
}

/// out += factor × symbol × x for a real symbol.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn add_real_symbol(out: &mut [Complex64], factor: f64, x: &[Complex64], symbol: &[f64]) {
    for ((out, x), symbol) in out.iter_mut().zip(x).zip(symbol) {
        *out += x * (factor * symbol);
    }
}

/// x ×= −i × factors.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn turn_back(x: &mut [Complex64], factors: &[f64]) {
    for (x, factor) in x.iter_mut().zip(factors) {
        *x = Complex64::new(x.im * factor, -x.re * factor);
    }
}

/// x ×= symbol.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn multiply_by(x: &mut [Complex64], symbol: &[Complex64]) {
    for (x, symbol) in x.iter_mut().zip(symbol) {
        *x *= symbol;
    }
}

/// x ×= factor × conjugate of symbol.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn multiply_by_conjugate(x: &mut [Complex64], factor: f64, symbol: &[Complex64]) {
    for (x, symbol) in x.iter_mut().zip(symbol) {
        *x *= symbol.conj() * factor;
    }
}
