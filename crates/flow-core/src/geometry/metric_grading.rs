//! The grading of a curve whose metric is known at its nodes. See `THEORY.md`, eq. (D8).

use super::grading::Grading;
use super::grading_error::GradingError;
use super::grid::{Complex64, PeriodicGrid};

impl Grading {
    /// The grading w = g/⟨g⟩ of the nodal `metric` g, at the midpoints by trigonometric interpolation.
    ///
    /// # Errors
    /// [`GradingError::NotPositive`] if the metric, or its interpolant between two nodes, is not positive; [`GradingError::Samples`]
    /// if there are fewer than two nodes.
    pub fn of_metric(metric: &[f64]) -> Result<Self, GradingError> {
        let nodes = metric.len();
        if nodes < Self::FEWEST_NODES {
            return Err(GradingError::Samples { samples: Self::samples(nodes) });
        }
        let mut grid = PeriodicGrid::new(nodes);
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(metric, &mut spectrum);
        let midpoints = grid.at_midpoints(&spectrum);
        let samples: Vec<f64> =
            metric.iter().zip(&midpoints).flat_map(|(node, next)| [*node, *next]).collect();
        Self::new(&samples)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn it_is_the_grading_that_the_metric_was_made_of() {
        for nodes in [32_usize, 45] {
            let weight = |s: f64| 1.0 + 0.6 * (2.0 * TAU * s).cos();
            let samples: Vec<f64> = (0..2 * nodes).map(|i| weight(i as f64 / (2 * nodes) as f64)).collect();
            let grading = Grading::new(&samples).unwrap();
            let metric: Vec<f64> = grading.weight().iter().map(|weight| 7.5 * weight).collect();
            let found = Grading::of_metric(&metric).unwrap();
            let pairs = found.at_midpoints().iter().zip(grading.at_midpoints());
            assert!(
                pairs.chain(found.weight().iter().zip(grading.weight())).all(|(a, b)| (a - b).abs() < 1e-14)
            );
        }
        let mut metric = vec![1.0; 32];
        metric[3] = -1.0;
        assert!(matches!(Grading::of_metric(&metric), Err(GradingError::NotPositive { .. })));
    }

    #[test]
    fn other_numbers_of_samples_are_refused() {
        for nodes in [0, 1] {
            let error = Grading::of_metric(&vec![1.0; nodes]);
            assert_eq!(error, Err(GradingError::Samples { samples: 2 * nodes }));
        }
        for samples in [0, 1, 2, 3, 5, 65] {
            assert_eq!(Grading::new(&vec![1.0; samples]), Err(GradingError::Samples { samples }));
        }
        assert!(Grading::new(&[1.0; 4]).is_ok());
    }
}
