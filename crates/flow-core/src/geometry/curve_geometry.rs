//! What a closed curve is, from the positions of its nodes alone. See `THEORY.md`, section 1 and eqs. (D1), (G1)–(G6).

use std::f64::consts::TAU;

use super::grid::{Complex64, PeriodicGrid};
use super::measures::enclosed_area;
use super::unit_vectors::unit_vectors;
use super::vectors::mean;

/// The positions are no curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum GeometryError {
    /// Too few nodes to tell a curve.
    #[error("`position` has {nodes} nodes, a curve needs {fewest} at least; sample it more finely")]
    TooFewNodes { nodes: usize, fewest: usize },
    /// A coordinate is NaN or infinite.
    #[error("`position` is ({x}, {y}) at node {node}: both coordinates must be finite")]
    NotFinite { node: usize, x: f64, y: f64 },
    /// The curve through the nodes has no direction.
    #[error(
        "the metric |dγ/ds| of `position` is {metric:.3e} at node {node}, {mean:.3e} on average: the curve stops there; \
         drop repeated nodes (the first one is not repeated at the end), and space the others more evenly"
    )]
    Stops { node: usize, metric: f64, mean: f64 },
    /// Two neighbours are one point.
    #[error(
        "nodes {node} and {next} of `position` are the same point; drop one of them (the first one is not repeated at the end)"
    )]
    Repeated { node: usize, next: usize },
    /// Too large or too small.
    #[error(
        "`position` is {length:.3e} long: the square of a length must be a number, neither too large nor too small for one; \
         choose another unit of length"
    )]
    OutOfScale { length: f64 },
}

/// Geometry of a closed curve at its nodes, by trigonometric interpolation of the positions in the parameter s = i/n.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveGeometry {
    /// Curvature κ, positive on a counter-clockwise circle (G2); one value per node, in 1/length.
    pub curvature: Vec<f64>,
    /// Metric g = |∂_sγ|; one value per node, in units of length.
    pub metric: Vec<f64>,
    /// Tangent angle θ, continued from node to node (G1).
    pub tangent_angle: Vec<f64>,
    /// Unit tangent τ = (cos θ, sin θ) (G1).
    pub tangent: Vec<[f64; 2]>,
    /// Unit normal n = (sin θ, −cos θ), outward on a counter-clockwise curve (G1).
    pub normal: Vec<[f64; 2]>,
    /// Length |Γ| = ∫g ds.
    pub length: f64,
    /// Enclosed area, positive for a counter-clockwise curve (G6).
    pub area: f64,
    /// Turns of the tangent along the curve: 1 for a counter-clockwise simple curve (G5).
    pub turning_number: i32,
    /// Gap |∫τ dσ| of the curve that curvature and metric make by (G3) and (G4), in units of length. The positions close
    /// by themselves: this is how far the nodes are from resolving the curve.
    pub closure_defect: f64,
}

/// As few as any shape may have.
const FEWEST_NODES: usize = 8;
/// Metric, relative to its mean, at which a curve stops.
const STOPS: f64 = 1e-10;

impl CurveGeometry {
    /// Geometry of the closed curve through the nodes `position`, of which the first is not repeated at the end.
    ///
    /// # Errors
    /// [`GeometryError`] if they are too few, not finite, stand still, or make a curve whose area would over- or underflow.
    /// # Source
    /// `THEORY.md`, eqs. (D1) and (G1)–(G6).
    pub fn of(position: &[[f64; 2]]) -> Result<Self, GeometryError> {
        let nodes = position.len();
        if nodes < FEWEST_NODES {
            return Err(GeometryError::TooFewNodes { nodes, fewest: FEWEST_NODES });
        }
        if let Some(node) = position.iter().position(|[x, y]| !(x.is_finite() && y.is_finite())) {
            let [x, y] = position[node];
            return Err(GeometryError::NotFinite { node, x, y });
        }
        let mut grid = PeriodicGrid::new(nodes);
        let [x, y] = [0, 1].map(|axis| position.iter().map(|point| point[axis]).collect::<Vec<f64>>());
        let ([dx, ddx], [dy, ddy]) = (derivatives(&mut grid, &x), derivatives(&mut grid, &y));
        let metric: Vec<f64> = dx.iter().zip(&dy).map(|(dx, dy)| dx.hypot(*dy)).collect();
        let length = mean(&metric);
        if let Some(node) = metric.iter().position(|g| *g <= STOPS * length) {
            return Err(GeometryError::Stops { node, metric: metric[node], mean: length });
        }
        // A node that is repeated makes waves, not a metric of zero.
        let chord = |node: usize| {
            let ([x, y], [next_x, next_y]) = (position[node], position[(node + 1) % nodes]);
            nodes as f64 * (next_x - x).hypot(next_y - y)
        };
        if let Some(node) = (0..nodes).find(|node| chord(*node) <= STOPS * length) {
            return Err(GeometryError::Repeated { node, next: (node + 1) % nodes });
        }
        if !(length * length).is_normal() {
            return Err(GeometryError::OutOfScale { length });
        }
        // By unit tangents: the third power of a metric over- and underflows long before its square does.
        let along = |i: usize| [dx[i] / metric[i], dy[i] / metric[i]];
        let curvature: Vec<f64> = (0..nodes)
            .map(|i| {
                let [x, y] = along(i);
                (x * ddy[i] - y * ddx[i]) / metric[i] / metric[i]
            })
            .collect();
        let (tangent_angle, turning_number) = continued_angles(&dx, &dy);
        let closure_defect = gap(&mut grid, &curvature, &metric);
        let per_length = [&dx, &dy].map(|d| d.iter().map(|d| d / length).collect::<Vec<f64>>());
        Ok(Self {
            tangent: (0..nodes).map(along).collect(),
            normal: (0..nodes).map(along).map(|[x, y]| [y, -x]).collect(),
            area: enclosed_area([&x, &y], [&per_length[0], &per_length[1]], length),
            curvature,
            metric,
            tangent_angle,
            length,
            turning_number,
            closure_defect,
        })
    }
}

/// First and second derivative by the parameter.
fn derivatives(grid: &mut PeriodicGrid, values: &[f64]) -> [Vec<f64>; 2] {
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(values, &mut spectrum);
    [1, 2].map(|order| {
        let of_mode = |(mode, value): (usize, &Complex64)| {
            value * Complex64::new(0.0, grid.wave_number(mode)).powi(order)
        };
        let derivative: Vec<Complex64> = spectrum.iter().enumerate().map(of_mode).collect();
        let mut out = vec![0.0; values.len()];
        grid.synthesise(&derivative, &mut out);
        out
    })
}

/// Angles of (dx, dy), each within half a turn of the one before, and the turns once around.
fn continued_angles(dx: &[f64], dy: &[f64]) -> (Vec<f64>, i32) {
    let nodes = dx.len();
    let mut angle = dy[0].atan2(dx[0]);
    let mut angles = Vec::with_capacity(nodes);
    let first = angle;
    for i in 0..nodes {
        angles.push(angle);
        let next = (i + 1) % nodes;
        let turn = dy[next].atan2(dx[next]) - angle;
        angle += turn - TAU * (turn / TAU).round();
    }
    (angles, ((angle - first) / TAU).round() as i32)
}

/// |∫τ dσ| with ∂_sθ = κg: (G3) and (G4) on the grid.
fn gap(grid: &mut PeriodicGrid, curvature: &[f64], metric: &[f64]) -> f64 {
    let nodes = curvature.len();
    let turning: Vec<f64> = curvature.iter().zip(metric).map(|(kappa, g)| kappa * g).collect();
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(&turning, &mut spectrum);
    let turning_per_node = spectrum[0].re / nodes as f64;
    grid.integrate(&mut spectrum);
    let mut theta = vec![0.0; nodes];
    grid.synthesise(&spectrum, &mut theta);
    theta.iter_mut().enumerate().for_each(|(i, theta)| *theta += turning_per_node * i as f64);
    let (mut cosine, mut sine) = (vec![0.0; nodes], vec![0.0; nodes]);
    unit_vectors(&theta, &mut cosine, &mut sine);
    let component = |tau: &[f64]| tau.iter().zip(metric).map(|(tau, g)| tau * g).sum::<f64>() / nodes as f64;
    component(&cosine).hypot(component(&sine))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// (2 cos φ, sin φ) at uneven φ, `turns` times around.
    fn ellipse(nodes: usize, turns: f64) -> Vec<[f64; 2]> {
        let s = (0..nodes).map(|i| i as f64 / nodes as f64);
        let phi = s.map(|s| turns * (TAU * s + 0.2 * (TAU * s).sin()));
        phi.map(f64::sin_cos).map(|(sine, cosine)| [2.0 * cosine, sine]).collect()
    }

    #[test]
    fn a_circle_is_exact() {
        let radius = 1.7;
        for nodes in [8_usize, 33, 64] {
            let phi = (0..nodes).map(|i| TAU * i as f64 / nodes as f64);
            let circle: Vec<[f64; 2]> = phi.map(|phi| [radius * phi.cos(), radius * phi.sin()]).collect();
            let geometry = CurveGeometry::of(&circle).unwrap();
            assert!((geometry.length - TAU * radius).abs() < 1e-13);
            assert!((geometry.area - PI * radius * radius).abs() < 1e-13);
            assert_eq!(geometry.turning_number, 1);
            assert!(geometry.closure_defect < 1e-13);
            for (i, [x, y]) in circle.iter().enumerate() {
                assert!((geometry.curvature[i] - 1.0 / radius).abs() < 1e-12);
                assert!((geometry.metric[i] - TAU * radius).abs() < 1e-12);
                assert!((geometry.tangent_angle[i] - PI / 2.0 - TAU * i as f64 / nodes as f64).abs() < 1e-12);
                let [nx, ny] = geometry.normal[i];
                assert!((nx - x / radius).abs() < 1e-13 && (ny - y / radius).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn an_ellipse_is_resolved_from_uneven_nodes() {
        let geometry = CurveGeometry::of(&ellipse(128, 1.0)).unwrap();
        assert!((geometry.length - 9.688448220547675).abs() < 1e-11, "{}", geometry.length);
        assert!((geometry.area - TAU).abs() < 1e-12);
        assert!((geometry.curvature[0] - 2.0).abs() < 1e-10);
        assert!(geometry.closure_defect < 1e-9, "{}", geometry.closure_defect);
        assert!(CurveGeometry::of(&ellipse(16, 1.0)).unwrap().closure_defect > 1e-4);
        let clockwise = CurveGeometry::of(&ellipse(128, -1.0)).unwrap();
        assert_eq!((clockwise.turning_number, clockwise.area < 0.0), (-1, true));
        assert_eq!(CurveGeometry::of(&ellipse(256, 2.0)).unwrap().turning_number, 2);
    }

    /// As far as the area is a number; beyond, nothing is told rather than something wrong.
    #[test]
    fn curves_of_every_scale_are_right_or_refused() {
        let unit = CurveGeometry::of(&ellipse(64, 1.0)).unwrap();
        let scaled = |scale: f64| -> Vec<[f64; 2]> {
            ellipse(64, 1.0).into_iter().map(|[x, y]| [scale * x, scale * y]).collect()
        };
        for exponent in [-150, -110, -60, 60, 104, 150] {
            let scale = 10_f64.powi(exponent);
            let geometry = CurveGeometry::of(&scaled(scale)).unwrap();
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
            assert!(close(geometry.length, scale * unit.length), "{scale:e}");
            assert!(close(geometry.area, scale * scale * unit.area), "{scale:e}");
            assert!(geometry.closure_defect <= 1e-3 * geometry.length, "{scale:e}");
            let pairs = geometry.curvature.iter().zip(&unit.curvature);
            assert!(pairs.into_iter().all(|(a, b)| close(scale * a, *b)), "{scale:e}");
        }
        for exponent in [-320, -310, -200, -160, 160, 307] {
            let error = CurveGeometry::of(&scaled(10_f64.powi(exponent))).expect_err("no area");
            assert!(matches!(error, GeometryError::OutOfScale { .. }), "{error}");
        }
    }

    #[test]
    fn errors_name_the_node() {
        assert_eq!(
            CurveGeometry::of(&ellipse(7, 1.0)),
            Err(GeometryError::TooFewNodes { nodes: 7, fewest: 8 })
        );
        let mut position = ellipse(16, 1.0);
        position[5][0] = f64::INFINITY;
        assert!(matches!(CurveGeometry::of(&position), Err(GeometryError::NotFinite { node: 5, .. })));
        let line: Vec<[f64; 2]> = (0..16).map(|i| [(TAU * f64::from(i) / 16.0).cos(), 0.0]).collect();
        assert!(matches!(CurveGeometry::of(&line), Err(GeometryError::Stops { node: 0, .. })));
        // A last node that is the first one, but for rounding.
        let mut closed = ellipse(64, 1.0);
        closed.push([closed[0][0], closed[0][1] - 2e-16]);
        assert!(matches!(CurveGeometry::of(&closed), Err(GeometryError::Repeated { node: 64, next: 0 })));
    }
}
