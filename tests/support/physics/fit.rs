//! Straight lines through measured points.

/// A slope and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// The slope.
    pub value: f64,
    /// Its standard error, from the scatter about the line.
    pub error: f64,
}

/// Least squares through points (x, y), of which there are three at least.
#[must_use]
pub fn line(points: &[[f64; 2]]) -> Slope {
    let n = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / n;
    let (x0, y0) = (mean(0), mean(1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|[x, y]| of(x - x0, y - y0)).sum::<f64>();
    let (xx, xy) = (sum(&|x, _| x * x), sum(&|x, y| x * y));
    let value = xy / xx;
    let scatter = sum(&|x, y| (y - value * x).powi(2)) / (n - 2.0);
    Slope { value, error: (scatter / xx).sqrt() }
}

/// Exponent p of y ∝ xᵖ.
#[must_use]
pub fn power(points: &[[f64; 2]]) -> Slope {
    line(&points.iter().map(|[x, y]| [x.ln(), y.ln()]).collect::<Vec<_>>())
}

impl std::fmt::Display for Slope {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{:.3} ± {:.3}", self.value, self.error)
    }
}

#[cfg(test)]
mod tests {
    use super::{line, power};

    #[test]
    fn a_line_has_its_slope_and_no_error() {
        let slope = line(&[[0.0, 1.0], [1.0, 3.0], [3.0, 7.0]]);
        assert!((slope.value - 2.0).abs() < 1e-15 && slope.error < 1e-15);
        assert!((power(&[[1.0, 2.0], [2.0, 16.0], [4.0, 128.0]]).value - 3.0).abs() < 1e-14);
    }

    #[test]
    fn scatter_makes_an_error() {
        let slope = line(&[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
        // Residuals −1/3, 2/3, −1/3 on one degree of freedom, Σx² = 2.
        assert!(slope.value.abs() < 1e-15 && (slope.error - (1.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
