//! How the values at the ticks of a linear axis are written: what they share stands in the name of the axis.

use super::numbers::{decade, power_of_ten, signed};
use crate::output::drawn::trimmed;

/// Digits of a label at most; values that need more are written as differences.
const MOST_DIGITS: i32 = 5;
/// Powers of ten whose numbers are written out.
const WRITTEN_OUT: std::ops::Range<i32> = -2..5;

/// A label is (value − origin) / 10^exponent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Notation {
    origin: f64,
    /// Decimals of the origin.
    precision: usize,
    exponent: i32,
    decimals: usize,
    /// Labels smaller than this are zero: rounding is not shown.
    zero: f64,
}

impl Notation {
    /// For ticks at multiples of `step` from `low` to `high`.
    pub fn new(low: f64, high: f64, step: f64) -> Self {
        let size = |low: f64, high: f64| decade(low.abs().max(high.abs()));
        let (mut origin, mut precision) = (0.0, 0);
        if size(low, high).saturating_sub(decade(step)) >= MOST_DIGITS {
            let place = (high - low).log10().ceil() as i32;
            let unit = 10_f64.powi(place);
            origin = (0.5 * (low + high) / unit).round() * unit;
            precision = decimals(place.saturating_neg());
        }
        let size = size(low - origin, high - origin);
        let exponent = if WRITTEN_OUT.contains(&size) { 0 } else { size };
        let decimals = decimals(exponent.saturating_sub(decade(step)));
        Self { origin, precision, exponent, decimals, zero: 1e-6 * step }
    }

    pub fn label(&self, value: f64) -> String {
        let value = value - self.origin;
        let value = if value.abs() < self.zero { 0.0 } else { value };
        signed(&format!("{:.*}", self.decimals, value / 10_f64.powi(self.exponent)))
    }

    /// The name with the origin and the power of ten that all labels leave out.
    pub fn title(&self, name: &str) -> String {
        let from = match self.origin {
            0.0 => String::new(),
            origin if origin < 0.0 => format!(" + {}", self.size_of_the_origin()),
            _ => format!(" − {}", self.size_of_the_origin()),
        };
        match self.exponent {
            0 => format!("{name}{from}"),
            exponent => format!("{name}{from}  [{}]", power_of_ten(exponent)),
        }
    }

    fn size_of_the_origin(&self) -> String {
        let size = self.origin.abs();
        let exponent = decade(size);
        if (-3..9).contains(&exponent) {
            return trimmed(&format!("{size:.*}", self.precision)).to_owned();
        }
        let factor = format!("{:.12}", size / 10_f64.powi(exponent));
        format!("{}×{}", trimmed(&factor), power_of_ten(exponent))
    }
}

/// A number of decimals; no double has more that mean something.
fn decimals(wanted: i32) -> usize {
    wanted.clamp(0, 20) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_varies_little_is_written_as_a_difference() {
        let far = Notation::new(1e6 - 1.3, 1e6 + 1.3, 0.5);
        assert_eq!([1e6 - 1.0, 1e6, 1e6 + 0.5].map(|x| far.label(x)), ["−1.0", "0.0", "0.5"]);
        assert_eq!(far.title("x"), "x − 1000000");
        let near = Notation::new(-0.500_001, -0.499_984, 5e-6);
        assert_eq!([-0.499_985, -0.5].map(|kappa| near.label(kappa)), ["1.5", "0.0"]);
        assert_eq!(near.title("κ"), "κ + 0.5  [10⁻⁵]");
        assert_eq!(Notation::new(2e12 - 3.0, 2e12 + 3.0, 1.0).title("x"), "x − 2×10¹²");
    }

    #[test]
    fn ends_that_are_equal_or_infinite_have_labels() {
        for (low, high) in [(0.0, 0.0), (5e-324, 5e-324), (f64::MIN, f64::MAX), (1.0, f64::INFINITY)] {
            let odd = Notation::new(low, high, high - low);
            assert!(odd.label(low).len() < 400 && odd.title("x").len() < 400);
        }
    }

    #[test]
    fn five_digits_need_no_difference() {
        let some = Notation::new(0.5884, 0.5901, 5e-4);
        assert_eq!((some.label(0.589), some.title("ρ")), ("0.5890".to_owned(), "ρ".to_owned()));
        let few = Notation::new(0.9e-6, 3.1e-6, 5e-7);
        assert_eq!((few.label(1.5e-6), few.title("length")), ("1.5".to_owned(), "length  [10⁻⁶]".to_owned()));
    }
}
