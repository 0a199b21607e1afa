//! An axis for `plotters`: linear or logarithmic, with labels that have no more digits than needed.

use std::ops::{Range, RangeInclusive};

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

use super::notation::Notation;
use super::numbers::{decade, tolerance};
use crate::output::drawn::range;

/// Labels at most.
pub(super) const LABELS: usize = 6;
/// Values that differ by more than this factor get a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 20.0;
/// Up to this factor, a logarithmic axis has labels at 1, 2 and 5, otherwise at powers of ten.
const FEW_DECADES: f64 = 1000.0;
/// Up to so many decades there is a grid line at every digit.
const GRID_DECADES: usize = 12;

/// Range and kind of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    pub logarithmic: bool,
    /// Labels wanted; fewer where there is no room for them.
    labels: usize,
}

impl Axis {
    pub fn linear(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: false, labels: LABELS }
    }

    /// From `low` to `high`, both positive.
    pub fn logarithmic(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: true, labels: LABELS }
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

    /// The same axis with about so many labels.
    pub fn with_labels(self, labels: usize) -> Self {
        Self { labels, ..self }
    }

    /// Place of `value` along the axis: 0 at its low end, 1 at its high end.
    pub fn place(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// Its low end.
    pub fn low(&self) -> f64 {
        self.low
    }

    /// How much of a linear axis that is `pixels` long a pixel is.
    pub fn per_pixel(&self, pixels: f64) -> f64 {
        (self.high - self.low) / pixels
    }

    /// The values that have labels.
    pub fn ticks(&self) -> Vec<f64> {
        if !self.logarithmic {
            return self.round_values();
        }
        let decades = self.decades().count();
        if decades <= 2 || self.has_few_decades() {
            if self.labels == LABELS {
                return self.digits(&[1.0, 2.0, 5.0]);
            }
            if decades <= 2 || self.labels > LABELS / 2 {
                return self.digits(&[1.0, 5.0]);
            }
        }
        let every = decades.div_ceil(self.labels).max(1);
        self.decades().step_by(every).map(|exponent| 10_f64.powi(exponent)).collect()
    }

    /// Round values on a linear axis: of one that is some units long, since `plotters` takes for zero what is small beside one.
    fn round_values(&self) -> Vec<f64> {
        let exponent = (self.high - self.low).log10().floor().clamp(-300.0, 300.0) as i32;
        let unit = 10_f64.powi(exponent.abs());
        let (shrunk, grown) = if exponent < 0 { (1.0, unit) } else { (unit, 1.0) };
        let scaled: RangedCoordf64 = (self.low / shrunk * grown..self.high / shrunk * grown).into();
        scaled.key_points(self.labels).into_iter().map(|value| value / grown * shrunk).collect()
    }

    /// The text at a tick, without what is in [`title`](Self::title).
    pub fn label(&self, value: f64) -> String {
        if !self.logarithmic {
            self.notation().label(value)
        } else if self.has_few_decades() {
            let decimals = usize::try_from(-decade(value)).unwrap_or(0);
            format!("{value:.decimals$}")
        } else {
            tolerance(value)
        }
    }

    /// The name with what all labels leave out.
    pub fn title(&self, name: &str) -> String {
        if self.logarithmic { name.to_owned() } else { self.notation().title(name) }
    }

    fn notation(&self) -> Notation {
        let step = match self.ticks()[..] {
            [first, second, ..] => second - first,
            _ => self.high - self.low,
        };
        Notation::new(self.low, self.high, step)
    }

    fn has_few_decades(&self) -> bool {
        self.high <= FEW_DECADES * self.low && self.low > 1e-3 && self.high < 1e5
    }

    /// Exponents of the powers of ten on the axis.
    fn decades(&self) -> RangeInclusive<i32> {
        // An end that is a power of ten but for rounding is one; one that is infinite ends where doubles do.
        let exponent = |value: f64| value.log10().clamp(-330.0, 310.0);
        (exponent(self.low) - 1e-9).ceil() as i32..=(exponent(self.high) + 1e-9).floor() as i32
    }

    /// These multiples of powers of ten.
    fn digits(&self, factors: &[f64]) -> Vec<f64> {
        let decades = self.decades().start() - 1..=*self.decades().end();
        let values = decades.flat_map(|k| factors.iter().map(move |factor| factor * 10_f64.powi(k)));
        values.filter(|value| (-1e-9..=1.0 + 1e-9).contains(&self.place(*value))).collect()
    }

    fn grid(&self) -> Vec<f64> {
        if !self.logarithmic {
            return Vec::new();
        }
        let every_digit = self.decades().count() <= GRID_DECADES;
        self.digits(if every_digit { &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0] } else { &[1.0] })
    }

    fn as_linear(&self) -> RangedCoordf64 {
        (self.low..self.high).into()
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        if self.logarithmic {
            let length = f64::from(limit.1) - f64::from(limit.0);
            (f64::from(limit.0) + length * self.place(*value).clamp(0.0, 1.0)).round() as i32
        } else {
            self.as_linear().map(value, limit)
        }
    }

    /// More points than labels are those of the grid.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match hint.max_num_points() {
            0 => Vec::new(),
            1..=LABELS => self.ticks(),
            _ => self.grid(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|value| axis.label(value)).collect()
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
        for unit in [1e-26, 1e-15, 1.0, 1e20] {
            assert_eq!(
                labels(Axis::linear(0.9 * unit, 3.1 * unit)),
                ["1.0", "1.5", "2.0", "2.5", "3.0"],
                "{unit}"
            );
        }
        assert_eq!(labels(Axis::fitted([5.6, 320.0], 0.05)), ["5", "10", "20", "50", "100", "200"]);
    }

    #[test]
    fn one_decade_has_labels_whatever_its_size() {
        let tiny = Axis::logarithmic(1e-23, 1.001e-22);
        assert_eq!(labels(tiny), ["10⁻²³", "2×10⁻²³", "5×10⁻²³", "10⁻²²"]);
        assert_eq!(labels(tiny.with_labels(2)), ["10⁻²³", "5×10⁻²³", "10⁻²²"]);
        assert_eq!(labels(Axis::logarithmic(1.1e-24, 1e-23)).len(), 3);
        assert!(labels(Axis::logarithmic(5e-324, f64::INFINITY)).len() <= LABELS);
    }
}
