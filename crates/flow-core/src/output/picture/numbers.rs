//! Numbers as texts.

use crate::output::drawn::trimmed;

/// A number in running text, with about three digits.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || (1e-2..1e5).contains(&value.abs()) {
        return signed(trimmed(&format!("{value:.3}")));
    }
    let exponent = value.abs().log10().floor() as i32;
    signed(&format!("{:.2} × {}", value / 10_f64.powi(exponent), power_of_ten(exponent)))
}

/// A number of one to three digits, such as a tolerance: `10⁻³`, `3×10⁻³`.
pub(super) fn tolerance(value: f64) -> String {
    let exponent = decade(value);
    let factor = format!("{:.2}", value / 10_f64.powi(exponent));
    match trimmed(&factor) {
        "1" => power_of_ten(exponent),
        factor => format!("{factor}×{}", power_of_ten(exponent)),
    }
}

/// `10⁻³`, with superscripts.
pub(super) fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let superscript = digits.chars().map(|digit| match digit.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    });
    format!("10{}", superscript.collect::<String>())
}

/// With a true minus sign.
pub(super) fn signed(text: &str) -> String {
    text.replace('-', "−")
}

/// The power of ten at or below a positive value.
pub(super) fn decade(value: f64) -> i32 {
    // A power of ten may be a little less by rounding.
    (value.log10() + 1e-9).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(
            ["12.5", "1000", "1.50 × 10⁻⁷", "0", "−0.25"],
            [12.5, 1000.0, 1.5e-7, 0.0, -0.25].map(number)[..]
        );
        assert_eq!(["10⁻³", "3×10⁻⁵", "2.5×10⁻¹⁰", "10⁻¹"], [1e-3, 3e-5, 2.5e-10, 0.1].map(tolerance)[..]);
    }
}
