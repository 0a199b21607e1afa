//! The curves a scene can name.

use super::curve::Curve;
use super::error::ShapeError;
use super::points::Interpolated;
use super::resample::{ByArcLength, Resampled};
use crate::expression::Expression;
use crate::geometry::Grading;

/// A closed curve γ(φ), φ ∈ [0, 2π), counter-clockwise where it encloses an area.
///
/// Lengths are in the scene's unit.
#[derive(Clone, Debug)]
pub enum Shape {
    /// The circle about the origin.
    Circle {
        /// Radius R > 0.
        radius: f64,
    },
    /// The ellipse (a cos φ, b sin φ).
    Ellipse {
        /// Semi-axes a, b > 0 along x and y.
        semi_axes: [f64; 2],
    },
    /// The paper's three-fold curve r = 1 + 0.35 cos 3φ, γ = r(cos φ, sin φ) + (0.05 sin 4φ, 0).
    Trillium,
    /// Gerono's lemniscate (a sin φ, a sin φ cos φ), which crosses itself at the origin: turning number 0.
    FigureEight {
        /// Half width a > 0.
        size: f64,
    },
    /// The curve r(φ)(cos φ, sin φ).
    Polar {
        /// Radius as a function of the variable 0, φ.
        r: Expression,
    },
    /// The curve (x(φ), y(φ)).
    Parametric {
        /// x as a function of the variable 0, φ.
        x: Expression,
        /// y as a function of the variable 0, φ.
        y: Expression,
    },
    /// The trigonometric interpolant through these points, in their order; the first is not repeated at the end.
    Points(Vec<[f64; 2]>),
}

impl Shape {
    /// The curve at `nodes` nodes of equal arc length, the first at φ = 0, exact to rounding.
    ///
    /// Whether `nodes` resolve the curve is for the caller to judge; so is a turning number of 0, 2 or more.
    /// # Shapes
    /// [`Resampled::curvature`] and [`Resampled::position`]: one value per node.
    /// # Errors
    /// [`ShapeError`] if the curve is not smooth, closed and counter-clockwise.
    /// # Panics
    /// If `nodes` is 0.
    pub fn resample(&self, nodes: usize) -> Result<Resampled, ShapeError> {
        self.by_arc_length()?.resample(nodes)
    }

    /// The curve at graded nodes; node 0 is γ(φ = 0).
    /// # Errors
    /// As [`resample`](Self::resample).
    pub fn resample_graded(&self, grading: &Grading) -> Result<Resampled, ShapeError> {
        self.by_arc_length()?.resample_graded(grading)
    }

    /// The length |Γ|, to a relative 1e-12.
    /// # Errors
    /// As [`resample`](Self::resample).
    pub fn length(&self) -> Result<f64, ShapeError> {
        Ok(self.by_arc_length()?.length())
    }

    /// The curve by its arc length, for nodes of many numbers.
    /// # Errors
    /// As [`resample`](Self::resample).
    pub fn by_arc_length(&self) -> Result<ByArcLength, ShapeError> {
        ByArcLength::new(self.curve()?)
    }

    fn curve(&self) -> Result<Curve, ShapeError> {
        match self {
            Self::Circle { radius } => scaled("cos(phi)", "sin(phi)", [*radius; 2]),
            Self::Ellipse { semi_axes } => scaled("cos(phi)", "sin(phi)", *semi_axes),
            Self::Trillium => scaled(
                "(1 + 0.35*cos(3*phi))*cos(phi) + 0.05*sin(4*phi)",
                "(1 + 0.35*cos(3*phi))*sin(phi)",
                [1.0; 2],
            ),
            Self::FigureEight { size } => scaled("sin(phi)", "sin(phi)*cos(phi)", [*size; 2]),
            Self::Polar { r } => Ok(Curve::polar(of_phi(r)?)?),
            Self::Parametric { x, y } => Ok(Curve::cartesian(of_phi(x)?, of_phi(y)?)?),
            Self::Points(points) => Ok(Curve::Interpolated(Interpolated::new(points)?)),
        }
    }
}

/// A formula that depends on φ alone.
fn of_phi(formula: &Expression) -> Result<&Expression, ShapeError> {
    match formula.arity() {
        0 | 1 => Ok(formula),
        _ => Err(ShapeError::OtherVariables { text: formula.text().to_owned() }),
    }
}

/// The curve (a x(φ), b y(φ)) for `size` = (a, b).
fn scaled(x: &str, y: &str, size: [f64; 2]) -> Result<Curve, ShapeError> {
    if let Some(&value) = size.iter().find(|size| !(size.is_finite() && **size > 0.0)) {
        return Err(ShapeError::SizeNotPositive { value });
    }
    let expression = |text: &str, size: f64| Expression::parse(&format!("{size:?}*({text})"), &["phi"]);
    Ok(Curve::cartesian(&expression(x, size[0])?, &expression(y, size[1])?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Embedding;

    fn parametric(x: &str, y: &str) -> Shape {
        let parse = |text| Expression::parse(text, &["phi"]).unwrap();
        Shape::Parametric { x: parse(x), y: parse(y) }
    }

    fn polar(r: &str) -> Shape {
        Shape::Polar { r: Expression::parse(r, &["phi"]).unwrap() }
    }

    /// Largest distance between the nodes and the curve rebuilt from curvature, length and placement, and the gap.
    fn rebuilt(curve: &Resampled) -> (f64, f64) {
        let turning: Vec<f64> = curve.curvature.iter().map(|kappa| kappa * curve.length).collect();
        let mut embedding = Embedding::new(turning.len());
        embedding.set_tangent(&turning, curve.length, curve.angle);
        embedding.set_position(curve.length, curve.centre);
        let ([x, y], [gap_x, gap_y]) = (embedding.position(), embedding.gap());
        let distances = curve.position.iter().zip(x).zip(y).map(|((p, x), y)| (p[0] - x).hypot(p[1] - y));
        (distances.fold(0.0, f64::max), gap_x.hypot(gap_y))
    }

    fn assert_close(value: f64, exact: f64, tolerance: f64) {
        assert!((value - exact).abs() <= tolerance, "{value} ≠ {exact}");
    }

    #[test]
    fn a_circle_is_exact() {
        for (radius, nodes) in [(1.0, 16), (2.5, 101), (1e-6, 64), (3e5, 7)] {
            let curve = Shape::Circle { radius }.resample(nodes).unwrap();
            assert_close(curve.length, std::f64::consts::TAU * radius, 2e-15 * curve.length);
            assert_eq!(curve.turning_number, 1);
            assert_close(curve.angle, std::f64::consts::FRAC_PI_2, 1e-14);
            assert!(curve.centre[0].hypot(curve.centre[1]) < 1e-15 * curve.length);
            assert_eq!(curve.position[0], [radius, 0.0]);
            for kappa in curve.curvature {
                assert_close(kappa * radius, 1.0, 1e-15);
            }
        }
    }

    #[test]
    fn lengths_are_the_known_ones() {
        let ellipse = Shape::Ellipse { semi_axes: [2.0, 1.0] };
        assert_close(ellipse.length().unwrap(), 9.688448220547675, 1e-14);
        assert_close(Shape::Trillium.length().unwrap(), 7.821482073066, 1e-11);
    }

    #[test]
    fn nodes_are_equidistant_along_the_curve() {
        for (shape, nodes) in [
            (Shape::Trillium, 1024),
            (Shape::Trillium, 1025),
            (Shape::Ellipse { semi_axes: [2.0, 1.0] }, 256),
            (Shape::FigureEight { size: 0.7 }, 512),
            (polar("2 + cos(phi) + 0.3*sin(2*phi)"), 512),
            (parametric("cos(2*phi) + 1.5*cos(phi)", "sin(2*phi) + 1.5*sin(phi)"), 1024),
        ] {
            let curve = shape.resample(nodes).unwrap();
            let (distance, gap) = rebuilt(&curve);
            assert!(gap < 1e-12 * curve.length, "{shape:?}: gap {gap:.1e}");
            assert!(distance < 1e-12 * curve.length, "{shape:?}: distance {distance:.1e}");
        }
    }

    #[test]
    fn the_gap_closes_twice_as_fast_as_the_positions_converge() {
        let curve = Shape::Trillium.resample(512).unwrap();
        let (distance, gap) = rebuilt(&curve);
        assert!(gap < 1e-12 * curve.length && distance < 1e-9, "gap {gap:.1e}, distance {distance:.1e}");
    }

    #[test]
    fn turning_numbers_are_counted() {
        let turns = |shape: Shape| shape.resample(64).unwrap().turning_number;
        assert_eq!(turns(Shape::FigureEight { size: 2.0 }), 0);
        assert_eq!(turns(parametric("cos(2*phi) + 1.5*cos(phi)", "sin(2*phi) + 1.5*sin(phi)")), 2);
        let error = parametric("sin(phi)", "cos(phi)").resample(64).unwrap_err();
        assert_eq!(error, ShapeError::Clockwise { turning_number: -1 });
    }

    #[test]
    fn points_reproduce_their_curve() {
        for nodes in [256, 257] {
            let ellipse = Shape::Ellipse { semi_axes: [2.0, 1.0] }.resample(nodes).unwrap();
            let again = Shape::Points(ellipse.position.clone()).resample(nodes).unwrap();
            assert_close(again.length, ellipse.length, 1e-13);
            assert_close(again.angle, ellipse.angle, 1e-13);
            for i in 0..nodes {
                assert_close(again.curvature[i], ellipse.curvature[i], 1e-10);
                assert_close(again.position[i][0], ellipse.position[i][0], 1e-13);
                assert_close(again.position[i][1], ellipse.position[i][1], 1e-13);
            }
        }
    }

    #[test]
    fn errors_say_where() {
        let error = |shape: Shape| shape.resample(64).unwrap_err();
        assert_eq!(error(Shape::Circle { radius: -1.0 }), ShapeError::SizeNotPositive { value: -1.0 });
        assert!(matches!(
            error(polar("sqrt(phi - 1)")),
            ShapeError::NotFinite { order: 0, axis: 0, phi: 0.0, .. }
        ));
        assert!(
            matches!(error(polar("1 + sin(phi)^2.5")), ShapeError::NotFinite { order: 0, phi, .. } if phi > 3.1)
        );
        assert!(matches!(error(parametric("3", "2")), ShapeError::ZeroLength { .. }));
        assert!(matches!(error(polar("1 + phi")), ShapeError::NotClosed { order: 0, gap, .. } if gap > 6.0));
        assert!(matches!(error(polar("1 + sin(phi/2)")), ShapeError::NotClosed { order: 1, .. }));
        let is_at = |error: ShapeError, expected: f64| match error {
            ShapeError::Stops { phi, .. } => (phi - expected).abs() < 1e-4,
            _ => false,
        };
        assert!(is_at(error(polar("1 + cos(phi)")), std::f64::consts::PI));
        assert!(is_at(error(polar("1 - cos(phi - 1)")), 1.0));
        assert!(matches!(error(polar("2 + abs(cos(phi))")), ShapeError::Corner { .. }));
        assert!(matches!(error(polar("2 + abs(sin(phi - 1))")), ShapeError::NotResolved { .. }));
        assert!(matches!(error(Shape::Points(Vec::new())), ShapeError::TooFewPoints { points: 0, .. }));
    }
}
