//! The exponential without branches or tables, so that loops over it vectorise.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use std::f64::consts::LOG2_E;

/// `1.5 × 2⁵²`: adding it rounds to the nearest integer and leaves that integer in the low bits.
const ROUNDING: f64 = 6755399441055744.0;
/// `ln 2` without its last bits, so that its product with any exponent is exact, and what is missing.
const LN_2_HIGH: f64 = 0.6931471803691238;
const LN_2_LOW: f64 = 1.9082149292705877e-10;
/// Beyond these arguments the result is ∞ or 0.
const LARGEST: f64 = 710.0;
const SMALLEST: f64 = -746.0;
/// `(eʳ − 1 − r)/r²` interpolated at the ten Chebyshev points of `|r| ≤ ln(2)/2`; error below 2e-17 of `eʳ`.
const TAIL: [f64; 10] = [
    0.5000000000000001,
    0.16666666666666669,
    0.04166666666662399,
    0.008333333333330051,
    0.0013888888917281794,
    0.00019841269863105968,
    2.480152119021773e-05,
    2.7557268378684192e-06,
    2.7620138719733994e-07,
    2.5100424157005067e-08,
];

/// `eˣ` within one unit in the last place; 0, ∞ and NaN where they belong, subnormals included.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    // Comparisons, not `clamp`: a NaN must pass through, and each line is one vector select.
    let x = if x > LARGEST { LARGEST } else { x };
    let x = if x < SMALLEST { SMALLEST } else { x };

    let shifted = x * LOG2_E + ROUNDING;
    let exponent = shifted - ROUNDING;
    let r = (x - exponent * LN_2_HIGH) - exponent * LN_2_LOW;

    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (TAIL[0] + TAIL[1] * r) + (TAIL[2] + TAIL[3] * r) * r2;
    let high = (TAIL[4] + TAIL[5] * r) + (TAIL[6] + TAIL[7] * r) * r2;
    let tail = low + r4 * (high + r4 * (TAIL[8] + TAIL[9] * r));
    let mantissa = 1.0 + (r + r2 * tail);

    // 2^exponent as two factors, each a normal number, so that the last product alone rounds or overflows.
    let biased = shifted.to_bits().wrapping_sub(ROUNDING.to_bits()).wrapping_add(2048);
    let half = biased >> 1;
    let first = f64::from_bits(half.wrapping_sub(1) << 52);
    let second = f64::from_bits(biased.wrapping_sub(half).wrapping_sub(1) << 52);
    mantissa * first * second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units in the last place between two positive numbers.
    fn ulps(a: f64, b: f64) -> u64 {
        a.to_bits().abs_diff(b.to_bits())
    }

    #[test]
    fn exp_is_within_one_ulp_of_the_standard_library() {
        let steps = 2_000_000;
        let mut worst = (0, 0.0);
        for (low, high) in [(-746.0, 710.0), (-1.0, 1.0), (-1e-9, 1e-9), (709.7, 709.8), (-745.2, -707.0)] {
            for i in 0..=steps {
                let x = low + (high - low) * f64::from(i) / f64::from(steps);
                let distance = ulps(exp(x), x.exp());
                if distance > worst.0 {
                    worst = (distance, x);
                }
            }
        }
        assert!(worst.0 <= 1, "{} ulp at {}", worst.0, worst.1);
    }

    #[test]
    fn exp_has_the_right_extremes() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-0.0), 1.0);
        for x in [709.782712893384, -745.1332191019411, -708.4, 5e-324, -5e-324] {
            assert!(ulps(exp(x), x.exp()) <= 1, "{x}");
        }
        for x in [709.7827128933841, 710.5, 1e300, f64::INFINITY] {
            assert_eq!(exp(x), f64::INFINITY, "{x}");
        }
        for x in [-745.2, -746.5, -1e300, f64::NEG_INFINITY] {
            assert_eq!(exp(x), 0.0, "{x}");
        }
        assert!(exp(f64::NAN).is_nan());
        assert!(exp(-f64::NAN).is_nan());
    }
}
