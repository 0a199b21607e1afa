//! An axis: a range, ticks at round numbers, and labels with no more digits than needed.

/// Linear or decadic axis with its ticks.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    logarithmic: bool,
    /// Values with labels.
    pub ticks: Vec<(f64, String)>,
    /// Values with a short mark only.
    pub minor: Vec<f64>,
    /// Power of ten that all labels leave out, as in `×10⁻³`.
    pub exponent: i32,
}

impl Axis {
    /// A linear axis over the finite `values`, with a margin of `margin` times their range on both sides.
    pub fn around(values: impl IntoIterator<Item = f64>, margin: f64, most_ticks: usize) -> Self {
        let (low, high) = range(values);
        let pad = margin * (high - low);
        Self::linear(low - pad, high + pad, most_ticks)
    }

    /// A linear axis from `low` to `high` with at most `most_ticks` ticks.
    pub fn linear(low: f64, high: f64, most_ticks: usize) -> Self {
        let step = round_step((high - low) / most_ticks as f64);
        let exponent = common_exponent(low.abs().max(high.abs()));
        let scale = 10_f64.powi(exponent);
        let decimals = (-(step / scale).log10().floor()).max(0.0) as usize;
        let first = (low / step - 1e-9).ceil();
        let count = ((high / step + 1e-9).floor() - first).max(0.0) as usize + 1;
        let ticks = (0..count).map(|i| (first + i as f64) * step);
        let ticks = ticks.map(|value| (value, signed(&format!("{:.decimals$}", value / scale + 0.0))));
        Self { low, high, logarithmic: false, ticks: ticks.collect(), minor: Vec::new(), exponent }
    }

    /// An axis of decades from `low` to `high`, both positive, with at most `most_ticks` labels.
    pub fn decades(low: f64, high: f64, most_ticks: u8) -> Self {
        let (first, last) = ((low.log10() - 1e-9).ceil() as i32, (high.log10() + 1e-9).floor() as i32);
        let every = ((last - first) / i32::from(most_ticks.max(1)) + 1).max(1);
        let labelled = |decade: i32| decade.rem_euclid(every) == 0;
        let ticks = (first..=last).filter(|decade| labelled(*decade));
        let ticks = ticks.map(|decade| (10_f64.powi(decade), power_of_ten(decade))).collect();
        let minor = if every == 1 {
            let all = (first - 1..=last).flat_map(|k| (2..10).map(move |m| f64::from(m) * 10_f64.powi(k)));
            all.filter(|value| (low..=high).contains(value)).collect()
        } else {
            (first..=last).filter(|decade| !labelled(*decade)).map(|decade| 10_f64.powi(decade)).collect()
        };
        Self { low, high, logarithmic: true, ticks, minor, exponent: 0 }
    }

    /// Place of `value` along the axis: 0 at its low end, 1 at its high end.
    pub fn place(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value.max(f64::MIN_POSITIVE) / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
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

/// `10⁻³`, with superscripts.
pub(super) fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.to_string();
    let superscript = digits.chars().map(|digit| match digit.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    });
    format!("10{}", superscript.collect::<String>())
}

/// A number in running text, with about four digits.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return signed(&value.to_string());
    }
    let exponent = size.log10().floor() as i32;
    if !(-3..5).contains(&exponent) {
        let mantissa = trimmed(&format!("{:.2}", value / 10_f64.powi(exponent)));
        return signed(&format!("{mantissa} × {}", power_of_ten(exponent)));
    }
    let decimals = (3 - exponent).max(0) as usize;
    signed(&trimmed(&format!("{value:.decimals$}")))
}

/// Without zeros at the end of the decimals.
fn trimmed(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

/// With a true minus sign.
fn signed(text: &str) -> String {
    text.replace('-', "−")
}

/// The next larger of 1, 2, 2.5, 5 × 10ᵏ; 2.5 is left out, since its labels need one more digit.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= step * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

fn common_exponent(size: f64) -> i32 {
    let exponent = size.log10().floor();
    if (-2.0..5.0).contains(&exponent) { 0 } else { exponent as i32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(labels(&Axis::linear(-1.03, 1.9, 6)), ["−1.0", "−0.5", "0.0", "0.5", "1.0", "1.5"]);
        assert_eq!(labels(&Axis::linear(0.0, 100.0, 5)), ["0", "20", "40", "60", "80", "100"]);
        let small = Axis::linear(1.0e-6, 3.0e-6, 4);
        assert_eq!((labels(&small), small.exponent), (vec!["1.0", "1.5", "2.0", "2.5", "3.0"], -6));
        assert_eq!(labels(&Axis::decades(1e-3, 1e2, 9)), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²"]);
        assert_eq!(labels(&Axis::decades(2e-6, 1e3, 5)), ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰", "10²"][1..]);
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
            ["12.5", "1000", "1.5 × 10⁻⁷", "0"].map(str::to_owned),
            [12.5, 1000.0, 1.5e-7, 0.0].map(number)
        );
    }
}
