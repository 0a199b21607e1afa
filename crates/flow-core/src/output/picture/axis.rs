//! An axis for `plotters`: linear or logarithmic, with labels that have no more digits than needed.

use std::ops::Range;

use plotters::coord::combinators::{IntoLogRange, LogCoord};
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

/// Labels at most.
pub(super) const LABELS: usize = 6;
/// Values that differ by more than this factor get a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 20.0;
/// Up to this factor, a logarithmic axis has labels at 1, 2 and 5, otherwise at powers of ten.
const FEW_DECADES: f64 = 1000.0;

/// Range and kind of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    pub logarithmic: bool,
}

impl Axis {
    pub fn linear(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: false }
    }

    /// From `low` to `high`, both positive.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: true }
    }

    /// A linear axis over the finite `values`, with a margin of `margin` times their range on both sides.
    pub fn around(values: impl IntoIterator<Item = f64>, margin: f64) -> Self {
        let (low, high) = range(values);
        let pad = margin * (high - low);
        Self::linear(low - pad, high + pad)
    }

    /// As [`around`](Self::around), but logarithmic if the values are positive and differ by a large factor.
    pub fn fitted(values: impl IntoIterator<Item = f64> + Clone, margin: f64) -> Self {
        let (low, high) = range(values.clone());
        if low <= 0.0 || high < LOGARITHMIC_FROM * low {
            return Self::around(values, margin);
        }
        let factor = (high / low).powf(margin);
        Self::logarithmic(low / factor, high * factor)
    }

    /// Place of `value` along the axis: 0 at its low end, 1 at its high end.
    pub fn place(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// The text at a tick, without the power of ten in [`title`](Self::title).
    pub fn label(&self, value: f64) -> String {
        if self.logarithmic && !self.has_few_decades() {
            return power_of_ten(value.log10().round() as i32);
        }
        let unit = 10_f64.powi(self.exponent());
        let step = if self.logarithmic { value } else { self.step() } / unit;
        let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
        let value = if value.abs() < 1e-9 * self.size() { 0.0 } else { value };
        signed(&format!("{:.decimals$}", value / unit))
    }

    /// The name with the power of ten that all labels leave out.
    pub fn title(&self, name: &str) -> String {
        match self.exponent() {
            0 => name.to_owned(),
            exponent => format!("{name}  [{}]", power_of_ten(exponent)),
        }
    }

    fn exponent(&self) -> i32 {
        let exponent = self.size().log10().floor();
        if self.logarithmic || (-2.0..5.0).contains(&exponent) { 0 } else { exponent as i32 }
    }

    fn size(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    fn has_few_decades(&self) -> bool {
        self.high <= FEW_DECADES * self.low && self.low > 1e-3 && self.high < 1e5
    }

    fn step(&self) -> f64 {
        match self.as_linear().key_points(LABELS)[..] {
            [first, second, ..] => second - first,
            _ => self.high - self.low,
        }
    }

    fn as_linear(&self) -> RangedCoordf64 {
        (self.low..self.high).into()
    }

    fn as_logarithmic(&self) -> LogCoord<f64> {
        (self.low..self.high).log_scale().into()
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        if self.logarithmic {
            self.as_logarithmic().map(value, limit)
        } else {
            self.as_linear().map(value, limit)
        }
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if !self.logarithmic {
            return self.as_linear().key_points(hint);
        }
        if !self.has_few_decades() || hint.max_num_points() > LABELS {
            return self.as_logarithmic().key_points(hint);
        }
        let decades = self.low.log10().floor() as i32..=self.high.log10() as i32;
        let values = decades.flat_map(|k| [1.0, 2.0, 5.0].map(|factor| factor * 10_f64.powi(k)));
        values.filter(|value| (self.low..=self.high).contains(value)).collect()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

/// Smallest and largest finite value, kept apart by at least a millionth of their size.
pub(super) fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    if high - low > 1e-6 * size {
        (low, high)
    } else {
        let half = if size > 0.0 { 0.05 * size } else { 1.0 };
        (low - half, high + half)
    }
}

/// A number in running text, with about three digits.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || (1e-2..1e5).contains(&value.abs()) {
        let text = format!("{value:.3}");
        return signed(text.trim_end_matches('0').trim_end_matches('.'));
    }
    let exponent = value.abs().log10().floor() as i32;
    signed(&format!("{:.2} × {}", value / 10_f64.powi(exponent), power_of_ten(exponent)))
}

/// A tolerance in running text: `10⁻³`, `3×10⁻³`.
pub(super) fn tolerance(value: f64) -> String {
    let exponent = (value.log10() + 1e-9).floor() as i32;
    let factor = format!("{:.2}", value / 10_f64.powi(exponent));
    match factor.trim_end_matches('0').trim_end_matches('.') {
        "1" => power_of_ten(exponent),
        factor => format!("{factor}×{}", power_of_ten(exponent)),
    }
}

/// `10⁻³`, with superscripts.
fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let superscript = digits.chars().map(|digit| match digit.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    });
    format!("10{}", superscript.collect::<String>())
}

/// With a true minus sign.
fn signed(text: &str) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: Axis) -> Vec<String> {
        axis.key_points(LABELS).into_iter().map(|value| axis.label(value)).collect()
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(labels(Axis::linear(-1.03, 1.9)), ["−1.0", "−0.5", "0.0", "0.5", "1.0", "1.5"]);
        assert_eq!(labels(Axis::linear(0.0, 101.0)), ["0", "20", "40", "60", "80", "100"]);
        assert_eq!(labels(Axis::logarithmic(0.9e-3, 1.1e2)), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²"]);
        assert_eq!(labels(Axis::logarithmic(0.9e-13, 99.0)), ["10⁻¹³", "10⁻¹⁰", "10⁻⁷", "10⁻⁴", "10⁻¹"]);
        let small = Axis::linear(0.9e-6, 3.1e-6);
        assert_eq!(labels(small), ["1.0", "1.5", "2.0", "2.5", "3.0"]);
        assert_eq!(small.title("length"), "length  [10⁻⁶]");
        assert_eq!(labels(Axis::fitted([5.6, 320.0], 0.05)), ["5", "10", "20", "50", "100", "200"]);
    }

    #[test]
    fn constant_and_missing_data_have_a_range() {
        assert_eq!(range([2.0, 2.0]), (1.9, 2.1));
        assert_eq!(range([f64::NAN]), (0.0, 1.0));
        assert_eq!(range([0.0]), (-1.0, 1.0));
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(
            ["12.5", "1000", "1.50 × 10⁻⁷", "0", "−0.25"],
            [12.5, 1000.0, 1.5e-7, 0.0, -0.25].map(number)[..]
        );
        assert_eq!(["10⁻³", "3×10⁻⁵", "2.5×10⁻¹⁰", "10⁻¹"], [1e-3, 3e-5, 2.5e-10, 0.1].map(tolerance)[..]);
    }
}
