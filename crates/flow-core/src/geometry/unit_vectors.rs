//! Cosines and sines of many angles at once, without branches or tables, so that the loop vectorises.

use std::f64::consts::FRAC_2_PI;

use multiversion::multiversion;

/// `1.5 × 2⁵²`: adding it rounds to the nearest integer and leaves that integer in the low bits.
const ROUNDING: f64 = 6755399441055744.0;
/// π/2 in parts of 33 bits, whose products with 20-bit integers are exact, and the rest.
const HALF_PI: [f64; 3] = [1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21];
/// (sin r/r − 1)/r² and (cos r − 1 + r²/2)/r⁴ in powers of r², best on |r| ≤ π/4; errors below 2⁻⁵⁷.
const SINE: [f64; 6] = [
    -0.16666666666666632,
    0.00833333333332249,
    -0.0001984126982985795,
    2.7557313707070068e-06,
    -2.5050760253406863e-08,
    1.58969099521155e-10,
];
const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887411,
    2.480158728947673e-05,
    -2.7557314351390663e-07,
    2.087572321298175e-09,
    -1.1359647557788195e-11,
];

/// cos θ and sin θ of every angle below 10⁵ in size, to two units in the last place of 1.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
pub(super) fn unit_vectors(angles: &[f64], cosines: &mut [f64], sines: &mut [f64]) {
    for ((angle, cosine), sine) in angles.iter().zip(cosines).zip(sines) {
        let shifted = angle * FRAC_2_PI + ROUNDING;
        let quarters = shifted - ROUNDING;
        let r = ((angle - quarters * HALF_PI[0]) - quarters * HALF_PI[1]) - quarters * HALF_PI[2];
        let z = r * r;
        let z2 = z * z;
        let polynomial = |c: &[f64; 6]| (c[0] + c[1] * z) + z2 * ((c[2] + c[3] * z) + z2 * (c[4] + c[5] * z));
        let s = r + r * z * polynomial(&SINE);
        let c = 1.0 - 0.5 * z + z2 * polynomial(&COSINE);
        let quarter = shifted.to_bits();
        let swap = quarter & 1 == 1;
        let (c, s) = if swap { (s, c) } else { (c, s) };
        // The signs as bits: cos < 0 in the second and third quarter, sin < 0 in the third and fourth.
        *cosine = f64::from_bits(c.to_bits() ^ (((quarter.wrapping_add(1) >> 1) & 1) << 63));
        *sine = f64::from_bits(s.to_bits() ^ (((quarter >> 1) & 1) << 63));
    }
}

#[cfg(test)]
mod tests {
    use super::unit_vectors;

    #[test]
    fn agree_with_the_standard_library() {
        let angles: Vec<f64> =
            (-40_000..40_000).map(|i| 0.37 * f64::from(i) + 1e-7 * f64::from(i).powi(2)).collect();
        let (mut cosines, mut sines) = (vec![0.0; angles.len()], vec![0.0; angles.len()]);
        unit_vectors(&angles, &mut cosines, &mut sines);
        for (i, angle) in angles.iter().enumerate() {
            let (sine, cosine) = angle.sin_cos();
            let error = (cosines[i] - cosine).abs().max((sines[i] - sine).abs());
            assert!(error <= 2.0 * f64::EPSILON, "θ = {angle}: {error:.1e}");
        }
    }

    #[test]
    fn what_is_not_finite_stays_so() {
        let (mut cosines, mut sines) = ([0.0; 3], [0.0; 3]);
        unit_vectors(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY], &mut cosines, &mut sines);
        assert!(cosines.iter().chain(&sines).all(|value| value.is_nan()));
    }
}
