//! The scalar weights of ETDRK4 at z = hλ. Cox & Matthews, J. Comput. Phys. 176 (2002) 430.

use flow_core::geometry::Complex64;

/// Weights for one eigenvalue; those of the rates still to be multiplied by h.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights {
    /// e^{z/2}.
    pub half: f64,
    /// (e^{z/2} − 1)/z.
    pub half_rate: f64,
    /// e^z.
    pub whole: f64,
    /// (−4 − z + e^z(4 − 3z + z²))/z³.
    pub first: f64,
    /// (2 + z + e^z(z − 2))/z³.
    pub middle: f64,
    /// (−4 − 3z − z² + e^z(4 − z))/z³.
    pub last: f64,
}

/// Below this |z| the formulas cancel, and a mean over a circle around z takes their place.
const SMALL: f64 = 2.0;
/// Points on the upper half of the circle; those below are their conjugates.
const POINTS: usize = 16;

impl Weights {
    /// The weights at a real `z`, by the contour integrals of Kassam & Trefethen, SISC 26 (2005) 1214, where
    /// the closed formulas cancel.
    #[must_use]
    pub fn at(z: f64) -> Self {
        let (half, whole) = ((0.5 * z).exp(), z.exp());
        if z.abs() >= SMALL {
            let [half_rate, first, middle, last] = closed(Complex64::new(z, 0.0)).map(|value| value.re);
            return Self { half, half_rate, whole, first, middle, last };
        }
        let mut sums = [0.0; 4];
        for point in 0..POINTS {
            let angle = std::f64::consts::PI * (point as f64 + 0.5) / POINTS as f64;
            for (sum, value) in sums.iter_mut().zip(closed(z + Complex64::from_polar(1.0, angle))) {
                *sum += value.re / POINTS as f64;
            }
        }
        let [half_rate, first, middle, last] = sums;
        Self { half, half_rate, whole, first, middle, last }
    }
}

fn closed(z: Complex64) -> [Complex64; 4] {
    let (e, cube) = (z.exp(), z * z * z);
    [
        ((0.5 * z).exp() - 1.0) / z,
        (-4.0 - z + e * (4.0 - 3.0 * z + z * z)) / cube,
        (2.0 + z + e * (z - 2.0)) / cube,
        (-4.0 - 3.0 * z - z * z + e * (4.0 - z)) / cube,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_zero_the_method_is_the_classical_one() {
        let weights = Weights::at(0.0);
        let sixth = 1.0 / 6.0;
        for (value, expected) in
            [(weights.half_rate, 0.5), (weights.first, sixth), (weights.middle, sixth), (weights.last, sixth)]
        {
            assert!((value - expected).abs() < 1e-14, "{value} ≠ {expected}");
        }
    }

    #[test]
    fn contour_and_closed_formula_meet() {
        for z in [-SMALL, SMALL] {
            let (inside, outside) = (Weights::at(z * (1.0 - 1e-15)), Weights::at(z));
            assert!((inside.first - outside.first).abs() < 1e-13);
            assert!((inside.middle - outside.middle).abs() < 1e-13);
            assert!((inside.last - outside.last).abs() < 1e-13);
        }
    }
}
