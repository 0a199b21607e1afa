//! Numbers in tables.

use crate::output::drawn::trimmed;

/// `value` with at most `digits` significant digits, as a person writes it.
pub(super) fn short(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        let name = if value.is_nan() { "not a number" } else { "∞" };
        return if value < 0.0 { format!("−{name}") } else { name.to_owned() };
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    let text = if (-3..6).contains(&exponent) {
        trimmed(&format!("{value:.*}", (digits - 1 - exponent).max(0) as usize)).to_owned()
    } else {
        let text = format!("{value:.*e}", (digits - 1).max(0) as usize);
        let (factor, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        format!("{}e{exponent}", trimmed(factor))
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_as_short_as_they_may_be() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (-2.5, "−2.5"),
            (5.604_831_2, "5.6048"),
            (323.944_48, "323.94"),
            (123_456.7, "123457"),
            (1e-3, "0.001"),
            (2.34e-12, "2.34e−12"),
            (1e9, "1e9"),
            (3_966_360.0, "3.9664e6"),
            (f64::NAN, "not a number"),
            (f64::NEG_INFINITY, "−∞"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value, 5), text);
        }
        assert_eq!(short(0.947_02, 3), "0.947");
    }
}
