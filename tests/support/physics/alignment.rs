//! Two curves laid on top of each other: same centre, best rotation, and where they cross.

use crate::{bisection, mean};

/// A closed curve as a polygon.
pub type Polygon = Vec<[f64; 2]>;

/// `curve` about its centre of nodes, which lie at equal distances along it.
#[must_use]
pub fn centred(curve: &[[f64; 2]]) -> Polygon {
    let [x, y] = [0, 1].map(|axis| mean(&curve.iter().map(|point| point[axis]).collect::<Vec<_>>()));
    curve.iter().map(|point| [point[0] - x, point[1] - y]).collect()
}

/// `curve` turned about the origin.
#[must_use]
pub fn turned(curve: &[[f64; 2]], angle: f64) -> Polygon {
    let (sin, cos) = angle.sin_cos();
    curve.iter().map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]).collect()
}

/// Distance from the origin of a star-shaped polygon in the direction `angle`.
fn radius(polygon: &[[f64; 2]], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let next = polygon.iter().cycle().skip(1);
    // p + t(q − p) = r(cos, sin), 0 ≤ t ≤ 1, r > 0.
    let hits = polygon.iter().zip(next).filter_map(|(p, q)| {
        let edge = [q[0] - p[0], q[1] - p[1]];
        let denominator = cos * edge[1] - sin * edge[0];
        let along = (sin * p[0] - cos * p[1]) / denominator;
        let distance = (p[0] * edge[1] - p[1] * edge[0]) / denominator;
        ((0.0..=1.0).contains(&along) && distance > 0.0).then_some(distance)
    });
    hits.fold(0.0, f64::max)
}

/// Two curves as radii over equally many directions.
#[derive(Clone, Debug)]
pub struct Aligned {
    /// Difference of the radii, of the second curve less the first, by direction.
    pub gap: Vec<f64>,
    /// Rotation of the second curve.
    pub angle: f64,
}

impl Aligned {
    /// Lays `second` on `first`, both star-shaped about their centres: the rotation with the least square gap.
    #[must_use]
    pub fn new(first: &[[f64; 2]], second: &[[f64; 2]], directions: usize) -> Self {
        let (first, second) = (centred(first), centred(second));
        let angles: Vec<f64> =
            (0..directions).map(|i| std::f64::consts::TAU * i as f64 / directions as f64).collect();
        let fixed: Vec<f64> = angles.iter().map(|angle| radius(&first, *angle)).collect();
        let gap = |rotation: f64| -> Vec<f64> {
            angles.iter().zip(&fixed).map(|(angle, r)| radius(&second, angle - rotation) - r).collect()
        };
        let square = |rotation: f64| gap(rotation).iter().map(|gap| gap * gap).sum::<f64>();
        // The flows turn the curve little: the slope changes sign within a tenth of a radian.
        let slope = |rotation: f64| square(rotation + 1e-4) - square(rotation - 1e-4);
        let angle = bisection([-0.1, 0.1], slope);
        Self { gap: gap(angle), angle }
    }

    /// How often the curves cross.
    #[must_use]
    pub fn crossings(&self) -> usize {
        crate::crossings(&self.gap, 0.0)
    }

    /// Directions of the crossings, in degrees.
    #[must_use]
    pub fn crossing_directions(&self) -> Vec<f64> {
        let n = self.gap.len();
        let at = |i: usize| (self.gap[i] > 0.0) != (self.gap[(i + 1) % n] > 0.0);
        (0..n).filter(|i| at(*i)).map(|i| 360.0 * (i as f64 + 0.5) / n as f64).collect()
    }

    /// Largest gap.
    #[must_use]
    pub fn largest_gap(&self) -> f64 {
        self.gap.iter().fold(0.0, |largest, gap| gap.abs().max(largest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_curve_is_turned_back() {
        let curve: Polygon = (0..200)
            .map(|i| {
                let phi = std::f64::consts::TAU * f64::from(i) / 200.0;
                [2.0 * phi.cos() + 0.3, phi.sin()]
            })
            .collect();
        let aligned = Aligned::new(&curve, &turned(&curve, 0.04), 360);
        assert!((aligned.angle + 0.04).abs() < 1e-6, "{}", aligned.angle);
        assert!(aligned.largest_gap() < 1e-6);
    }

    #[test]
    fn a_circle_crosses_an_ellipse_four_times() {
        let ellipse = |a: f64, b: f64| -> Polygon {
            (0..300)
                .map(|i| {
                    let phi = std::f64::consts::TAU * f64::from(i) / 300.0;
                    [a * phi.cos(), b * phi.sin()]
                })
                .collect()
        };
        assert_eq!(Aligned::new(&ellipse(1.1, 0.9), &ellipse(1.0, 1.0), 361).crossings(), 4);
    }
}
