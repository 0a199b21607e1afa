//! Symmetric stencils, polynomials in x = −δ² by their coefficients at the offsets 0, 1, …, and fields that are continued
//! periodically by their half-width on both sides.

/// Square of a polynomial.
pub(super) fn square(polynomial: &[f64]) -> Vec<f64> {
    let mut square = vec![0.0; 2 * polynomial.len() - 1];
    for (i, a) in polynomial.iter().enumerate() {
        for (j, b) in polynomial.iter().enumerate() {
            square[i + j] += a * b;
        }
    }
    square
}

/// Coefficients at the offsets 0, 1, … of a polynomial in x = −δ², by Horner's rule.
pub(super) fn half_stencil(polynomial: &[f64]) -> Vec<f64> {
    let width = polynomial.len() - 1;
    let mut stencil = vec![0.0; width + 1];
    for coefficient in polynomial.iter().rev() {
        let at = |k: isize| stencil.get(k.unsigned_abs()).copied().unwrap_or(0.0);
        stencil = (0..=width as isize).map(|k| 2.0 * at(k) - at(k - 1) - at(k + 1)).collect();
        stencil[0] += coefficient;
    }
    stencil
}

/// Copies nodal values between the margins, and fills these.
pub(super) fn pad(values: &[f64], padded: &mut [f64]) {
    let width = (padded.len() - values.len()) / 2;
    padded[width..width + values.len()].copy_from_slice(values);
    wrap(padded, width);
}

/// Fills the margins by the periodic continuation.
pub(super) fn wrap(padded: &mut [f64], width: usize) {
    let nodes = padded.len() - 2 * width;
    padded.copy_within(nodes..nodes + width, 0);
    padded.copy_within(width..2 * width, nodes + width);
}

/// out += factor × stencil ∗ padded.
pub(super) fn add_convolution(half: &[f64], factor: f64, padded: &[f64], out: &mut [f64]) {
    let (nodes, width) = (out.len(), (padded.len() - out.len()) / 2);
    for (k, coefficient) in half.iter().enumerate() {
        let weight = factor * if k == 0 { 0.5 * coefficient } else { *coefficient };
        let (left, right) = (&padded[width - k..][..nodes], &padded[width + k..][..nodes]);
        for ((out, left), right) in out.iter_mut().zip(left).zip(right) {
            *out += weight * (left + right);
        }
    }
}
