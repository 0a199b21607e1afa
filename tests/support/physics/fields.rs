//! Periodic fields on uniform nodes: correlation, slopes, values in between.

pub use flow_core::run::Interpolant;

use crate::mean;

/// Correlation of two fields over the nodes.
#[must_use]
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a0, b0) = (mean(a), mean(b));
    let sum = |of: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| of(a - a0, b - b0)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_correlates_with_itself() {
        let values: Vec<f64> = (0..32).map(|i| f64::from(i).sin()).collect();
        assert!((correlation(&values, &values) - 1.0).abs() < 1e-15);
    }
}
