//! Small polynomials in θ = (t − tₙ)/h, by their coefficients.

use super::orders::MOST_MOMENTS;

/// Coefficients, lowest first.
pub type Coefficients = [f64; MOST_MOMENTS];

/// ∏(θ − root) over `roots`, times `factor`.
pub fn with_roots(roots: impl IntoIterator<Item = f64>, factor: f64) -> Coefficients {
    let mut product = [0.0; MOST_MOMENTS];
    product[0] = factor;
    for (degree, root) in roots.into_iter().enumerate() {
        for i in (0..=degree).rev() {
            product[i + 1] += product[i];
            product[i] *= -root;
        }
    }
    product
}

/// The Lagrange polynomials of `points`.
pub fn lagrange_basis(points: &[f64]) -> [Coefficients; MOST_MOMENTS] {
    let mut basis = [[0.0; MOST_MOMENTS]; MOST_MOMENTS];
    for (j, (polynomial, point)) in basis.iter_mut().zip(points).enumerate() {
        let others = || points.iter().enumerate().filter(move |(i, _)| *i != j).map(|(_, other)| *other);
        *polynomial = with_roots(others(), 1.0 / others().map(|other| point - other).product::<f64>());
    }
    basis
}

/// The polynomial that is one at θ = 1 and zero at `points`: what a new value there adds to an interpolation.
pub fn of_new_value(points: &[f64]) -> Coefficients {
    with_roots(points.iter().copied(), 1.0 / at_one(points))
}

/// By how much an interpolation at `points` and 1 differs from that without the last point, for a new value that the points
/// miss by one.
pub fn of_last_point(points: &[f64]) -> Coefficients {
    let kept = &points[..points.len() - 1];
    with_roots(kept.iter().copied().chain([1.0]), 1.0 / at_one(points))
}

fn at_one(points: &[f64]) -> f64 {
    points.iter().map(|point| 1.0 - point).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(polynomial: &Coefficients, x: f64) -> f64 {
        polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    #[test]
    fn the_basis_is_one_at_its_point_and_zero_at_the_others() {
        let points = [0.0, -0.5, -1.25, -3.0];
        let basis = lagrange_basis(&points);
        for (j, polynomial) in basis[..points.len()].iter().enumerate() {
            for (i, point) in points.iter().enumerate() {
                assert!((at(polynomial, *point) - f64::from(u8::from(i == j))).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn a_new_value_is_taken_in_with_and_without_the_last_point() {
        let points = [0.0, -0.5, -1.25];
        let (with, difference) = (of_new_value(&points), of_last_point(&points));
        let without = of_new_value(&points[..2]);
        // The interpolation of (1, 0, 0, v) with all points minus that of (1, 0, 0): v is what the points say of the value 1.
        for x in [-2.0, -0.7, 0.3, 1.0] {
            let lagrange = at(&with, x);
            let missed = lagrange - at(&without, x) * (1.0 - 0.0);
            let scaled = at(&difference, x);
            assert!((missed - scaled).abs() < 1e-13, "{missed} ≠ {scaled}");
        }
    }
}
