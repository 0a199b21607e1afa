//! The distance of two nearby curves across each other, less the rigid motion that fits best.
//!
//! A flow moves the curve up to a rigid motion, and its nodes along it as the gauge says; neither is an error of the shape. So
//! only the part of a difference across the curve counts, and the motion is fitted to that part alone.

use nalgebra::{Matrix3, Vector3};

use super::super::interpolant::Interpolant;
use super::super::record::Frame;

/// Part of the square of the size below which a motion leaves the curve as it is: the rotation of a circle.
const INVISIBLE: f64 = 1e-10;
/// The fit is linear in the motion, so that its error squares in every round.
const ROUNDS: usize = 3;

/// A curve on equidistant parameters.
#[derive(Debug)]
pub(super) struct Curve {
    position: Vec<[f64; 2]>,
    tangent: Vec<[f64; 2]>,
    curvature: Vec<f64>,
}

impl Curve {
    /// The curve of `frame`.
    pub fn new(frame: &Frame) -> Self {
        let axis = |k: usize| {
            let values: Vec<f64> = frame.position.iter().map(|at| at[k]).collect();
            let slopes = Interpolant::new(&values).slopes(values.len());
            (values, slopes)
        };
        let ((x, x_s), (y, y_s)) = (axis(0), axis(1));
        let unit = |(x_s, y_s): (f64, f64)| [x_s / x_s.hypot(y_s), y_s / x_s.hypot(y_s)];
        Self {
            position: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
            tangent: x_s.into_iter().zip(y_s).map(unit).collect(),
            curvature: frame.curvature.clone(),
        }
    }

    fn centre(&self) -> [f64; 2] {
        let count = self.position.len() as f64;
        [0, 1].map(|k| self.position.iter().map(|at| at[k]).sum::<f64>() / count)
    }
}

/// Distances of the points of `curve` from `reference` after the best rigid motion; both have the same parameters.
pub(super) fn distances(curve: &Curve, reference: &Curve) -> Vec<f64> {
    let centre = reference.centre();
    let mut points = curve.position.clone();
    for _ in 0..ROUNDS {
        let motion = best_motion(&points, reference, centre);
        for point in &mut points {
            *point = undone(*point, centre, motion);
        }
    }
    let distance = |(i, point): (usize, &[f64; 2])| {
        let [along, across] = local(*point, reference, i);
        to_osculating_circle(along, across, reference.curvature[i]).abs()
    };
    points.iter().enumerate().map(distance).collect()
}

/// The difference from node `i` of `reference`, along its tangent and its normal.
fn local(point: [f64; 2], reference: &Curve, i: usize) -> [f64; 2] {
    let [[x, y], [tx, ty]] = [reference.position[i], reference.tangent[i]];
    let (dx, dy) = (point[0] - x, point[1] - y);
    [dx * tx + dy * ty, dx * ty - dy * tx]
}

/// Signed distance from the circle of the given curvature through the origin, whose tangent is the first axis and whose
/// outward normal the second: exact for any curvature, zero included.
fn to_osculating_circle(along: f64, across: f64, curvature: f64) -> f64 {
    let radial = (curvature * along).hypot(1.0 + curvature * across);
    (2.0 * across + curvature * (along * along + across * across)) / (1.0 + radial)
}

/// Shift and angle of the small rigid motion of `reference` about `centre` that comes nearest to `points`, in the
/// square mean across the curve.
fn best_motion(points: &[[f64; 2]], reference: &Curve, centre: [f64; 2]) -> Vector3<f64> {
    let (mut normal_matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (i, point) in points.iter().enumerate() {
        let ([x, y], [tx, ty]) = (reference.position[i], reference.tangent[i]);
        // The normal is (τ_y, −τ_x); a rotation moves the point by (−(y − c_y), x − c_x).
        let column = Vector3::new(ty, -tx, -(y - centre[1]) * ty - (x - centre[0]) * tx);
        let [_, across] = local(*point, reference, i);
        normal_matrix += column * column.transpose();
        right += column * across;
    }
    let size = normal_matrix.trace();
    let decomposed = normal_matrix.svd(true, true);
    decomposed.solve(&right, INVISIBLE * size).unwrap_or_else(|_| Vector3::zeros())
}

fn undone([x, y]: [f64; 2], [cx, cy]: [f64; 2], motion: Vector3<f64>) -> [f64; 2] {
    let (sin, cos) = motion.z.sin_cos();
    let (dx, dy) = (x - motion.x - cx, y - motion.y - cy);
    [cx + cos * dx + sin * dy, cy - sin * dx + cos * dy]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// An ellipse of curvature ab/(a² sin² + b² cos²)^{3/2}, its nodes moved along by `shift`.
    fn ellipse(semi_axes: [f64; 2], nodes: usize, shift: f64) -> Frame {
        let [a, b] = semi_axes;
        let angles: Vec<f64> = (0..nodes).map(|i| TAU * i as f64 / nodes as f64 + shift).collect();
        Frame {
            position: angles.iter().map(|phi| [a * phi.cos(), b * phi.sin()]).collect(),
            curvature: angles
                .iter()
                .map(|phi| a * b / (a * phi.sin()).hypot(b * phi.cos()).powi(3))
                .collect(),
            ..Frame::default()
        }
    }

    fn largest(curve: &Curve, reference: &Curve) -> f64 {
        distances(curve, reference).into_iter().fold(0.0, f64::max)
    }

    #[test]
    fn motions_and_labels_are_no_distance() {
        let reference = Curve::new(&ellipse([2.0, 1.0], 64, 0.0).resampled(128));
        let mut moved = ellipse([2.0, 1.0], 128, 1e-3);
        let (sin, cos) = 1e-2_f64.sin_cos();
        for point in &mut moved.position {
            let [x, y] = *point;
            *point = [cos * x - sin * y + 0.02, sin * x + cos * y - 0.01];
        }
        let found = largest(&Curve::new(&moved.resampled(128)), &reference);
        // The labels are 1e-3 apart: the osculating circle leaves the curve with the third power of that.
        assert!(found < 1e-8, "{found:.1e}");
    }

    #[test]
    fn what_no_motion_removes_is_the_distance() {
        let reference = Curve::new(&ellipse([2.0, 1.0], 64, 0.0));
        let longer = Curve::new(&ellipse([2.0 + 1e-6, 1.0], 64, 0.0));
        // Largest at the ends of the long axis, to which no shift or rotation helps.
        assert!((largest(&longer, &reference) - 1e-6).abs() < 1e-9);
        let circle = Curve::new(&ellipse([1.0, 1.0], 32, 0.0));
        let grown = Curve::new(&ellipse([1.1, 1.1], 32, 0.3));
        assert!((largest(&grown, &circle) - 0.1).abs() < 1e-12);
    }
}
