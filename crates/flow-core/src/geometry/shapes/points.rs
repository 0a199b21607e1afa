//! The smooth closed curve through a list of points: trigonometric interpolation in the index.

use std::f64::consts::TAU;

use super::error::ShapeError;
use super::jet::Jet;
use crate::geometry::{Complex64, PeriodicGrid};

/// Trigonometric interpolation, tabulated on a finer grid and read off it by polynomials.
#[derive(Debug)]
pub(super) struct Interpolated {
    points: usize,
    /// The interpolant at φ = 2πj/(`REFINEMENT` m).
    table: Vec<Jet>,
}

const FEWEST_POINTS: usize = 8;
/// Largest distance, relative to the diameter, of points that count as repeated.
const REPEATED: f64 = 1e-12;
/// Ratio of neighbouring distances from which on rough points are unevenly spaced, before anything else.
const UNEVEN: f64 = 1.5;
/// Largest share of the highest third of the modes in the second derivative.
const ROUGH: f64 = 1e-2;
const REFINEMENT: usize = 8;
/// Points of a local polynomial. On a grid refined eight times its error is below 1e-12 of the highest mode,
/// which is below 1e-3 of the curve.
const STENCIL: usize = 16;
/// Barycentric weights (−1)ʲ C(15, j) of equidistant points.
const BARYCENTRIC: [f64; STENCIL] = [
    1.0, -15.0, 105.0, -455.0, 1365.0, -3003.0, 5005.0, -6435.0, 6435.0, -5005.0, 3003.0, -1365.0, 455.0,
    -105.0, 15.0, -1.0,
];

impl Interpolated {
    /// Checks and interpolates `points`.
    pub(super) fn new(points: &[[f64; 2]]) -> Result<Self, ShapeError> {
        check(points)?;
        let mut grid = PeriodicGrid::new(points.len());
        let spectra = [0, 1].map(|axis| {
            let values: Vec<f64> = points.iter().map(|point| point[axis]).collect();
            let mut spectrum = vec![Complex64::default(); grid.modes()];
            grid.transform(&values, &mut spectrum);
            spectrum
        });
        let share = high_share(&spectra, points.len());
        // Written so that an overflow, hence NaN, is rough too.
        if share <= ROUGH {
            Ok(Self { points: points.len(), table: tabulate(&spectra, &grid) })
        } else {
            Err(rough(points, share))
        }
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        self.points
    }

    /// The curve and its derivatives at `phi`.
    pub(super) fn jet(&self, phi: f64) -> Jet {
        let position = phi / TAU * self.table.len() as f64;
        let left = position.floor();
        let offset = position - left;
        let nodes = self.table.len();
        let at = |node: usize| &self.table[(left.rem_euclid(nodes as f64) as usize + nodes + node) % nodes];
        if offset == 0.0 {
            return *at(0);
        }
        let (mut sum, mut weights) = ([[0.0; 2]; 3], 0.0);
        for (node, weight) in BARYCENTRIC.iter().enumerate() {
            let weight = weight / (offset + (STENCIL / 2 - 1) as f64 - node as f64);
            let jet = at(nodes + node - (STENCIL / 2 - 1));
            weights += weight;
            for (sum, value) in sum.as_flattened_mut().iter_mut().zip(jet.as_flattened()) {
                *sum += weight * value;
            }
        }
        sum.map(|components| components.map(|sum| sum / weights))
    }
}

fn check(points: &[[f64; 2]]) -> Result<(), ShapeError> {
    if points.len() < FEWEST_POINTS {
        return Err(ShapeError::TooFewPoints { points: points.len(), fewest: FEWEST_POINTS });
    }
    let infinite = points.iter().position(|point| !(point[0].is_finite() && point[1].is_finite()));
    if let Some(point) = infinite {
        return Err(ShapeError::PointNotFinite { point, position: points[point] });
    }
    let radius = points.iter().map(|&point| distance(point, points[0])).fold(0.0, f64::max);
    let bound = REPEATED * radius;
    for (first, &point) in points.iter().enumerate() {
        let second = (first + 1) % points.len();
        let distance = distance(point, points[second]);
        if distance <= bound {
            return Err(ShapeError::RepeatedPoints { first, second, distance, bound });
        }
    }
    Ok(())
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// What is rough: the spacing of `points`, whose interpolant takes the index for its parameter, or the points themselves.
#[cold]
fn rough(points: &[[f64; 2]], share: f64) -> ShapeError {
    let count = points.len();
    let step = |i: usize| distance(points[i % count], points[(i + 1) % count]);
    let distances = |point: usize| [step(point + count - 1), step(point)];
    let ratio = |point: usize| {
        let [before, after] = distances(point);
        (before / after).max(after / before)
    };
    let point = (0..count).max_by(|&a, &b| ratio(a).total_cmp(&ratio(b))).unwrap_or_default();
    if ratio(point) > UNEVEN {
        let [before, after] = distances(point);
        return ShapeError::UnevenPoints { points: count, point, before, after, share, bound: ROUGH };
    }
    ShapeError::RoughPoints { points: count, share, bound: ROUGH }
}

/// Share of the highest third of the modes in the root mean square of γ″, where roughness shows.
fn high_share(spectra: &[Vec<Complex64>; 2], points: usize) -> f64 {
    let (mut all, mut high) = (0.0, 0.0);
    for (mode, value) in spectra.iter().flat_map(|spectrum| spectrum.iter().enumerate()) {
        let square = (mode as f64).powi(4) * value.norm_sqr();
        all += square;
        if 3 * mode > points {
            high += square;
        }
    }
    (high / all).sqrt()
}

/// The interpolant and its derivatives on the finer grid.
fn tabulate(spectra: &[Vec<Complex64>; 2], grid: &PeriodicGrid) -> Vec<Jet> {
    let nodes = REFINEMENT * grid.nodes();
    let mut finer = PeriodicGrid::new(nodes);
    let (mut spectrum, mut values) = (vec![Complex64::default(); finer.modes()], vec![0.0; nodes]);
    let mut table = vec![[[0.0; 2]; 3]; nodes];
    for (axis, coarse) in spectra.iter().enumerate() {
        for order in 0..3 {
            spectrum.fill(Complex64::default());
            for (mode, value) in coarse.iter().enumerate() {
                // The sawtooth stood once in its spectrum and stands twice in the finer one.
                let multiplicity = grid.multiplicity(mode) / finer.multiplicity(mode);
                spectrum[mode] = multiplicity * value * Complex64::new(0.0, mode as f64).powu(order);
            }
            finer.synthesise(&spectrum, &mut values);
            for (jet, value) in table.iter_mut().zip(&values) {
                jet[order as usize][axis] = *value;
            }
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ellipse (2 cos φ + 1, sin φ) at m values of φ.
    fn ellipse(points: usize) -> Vec<[f64; 2]> {
        let phi = (0..points).map(|i| TAU * i as f64 / points as f64);
        phi.map(f64::sin_cos).map(|(sine, cosine)| [2.0 * cosine + 1.0, sine]).collect()
    }

    #[test]
    fn trigonometric_curves_are_exact() {
        for points in [8, 9, 100, 301] {
            let curve = Interpolated::new(&ellipse(points)).unwrap();
            for phi in [0.0_f64, 1e-9, 0.3, 2.0, 3.0, 6.2] {
                let (sine, cosine) = phi.sin_cos();
                let exact = [[2.0 * cosine + 1.0, sine], [-2.0 * sine, cosine], [-2.0 * cosine, -sine]];
                let jet = curve.jet(phi);
                for (a, b) in jet.as_flattened().iter().zip(exact.as_flattened()) {
                    assert!((a - b).abs() < 1e-13 * points as f64, "{points} points, φ = {phi}: {a} ≠ {b}");
                }
            }
        }
    }

    #[test]
    fn the_sawtooth_is_a_cosine() {
        let points: Vec<[f64; 2]> = ellipse(8)
            .iter()
            .zip([1e-4, -1e-4].iter().cycle())
            .map(|([x, y], wave)| [x + wave, *y])
            .collect();
        let jet = Interpolated::new(&points).unwrap().jet(0.0);
        assert!((jet[0][0] - 3.0001).abs() < 1e-14 && jet[1][0].abs() < 1e-14);
        assert!((jet[2][0] + 2.0 + 16e-4).abs() < 1e-13);
    }

    #[test]
    fn errors_name_the_point() {
        let error = |points: Vec<[f64; 2]>| Interpolated::new(&points).unwrap_err();
        assert_eq!(error(ellipse(7)), ShapeError::TooFewPoints { points: 7, fewest: 8 });
        let mut points = ellipse(20);
        points[3][1] = f64::INFINITY;
        let position = points[3];
        assert_eq!(error(points), ShapeError::PointNotFinite { point: 3, position });
        let mut points = ellipse(20);
        points.push(points[0]);
        assert!(matches!(error(points), ShapeError::RepeatedPoints { first: 20, second: 0, .. }));
        let zigzag = |(i, &[x, y]): (usize, &[f64; 2])| [x + 0.01 * (i % 2) as f64, y];
        let points = ellipse(20).iter().enumerate().map(zigzag).collect();
        assert!(matches!(error(points), ShapeError::RoughPoints { points: 20, .. }));
        let parameters = (0..100).map(|i| (f64::from(i) + 0.4 * f64::from(i * i % 3)) / 100.0);
        let uneven = parameters.map(|s| (TAU * s).sin_cos()).map(|(y, x)| [1.3 * x, 0.8 * y]).collect();
        assert!(matches!(error(uneven), ShapeError::UnevenPoints { points: 100, .. }));
        let mut points = ellipse(64);
        points.insert(10, [points[10][0] + 1e-7, points[10][1]]);
        let text = error(points).to_string();
        assert!(text.contains("at point 11 (from 0)") && text.contains("1.000e-7"), "{text}");
        let square = (0..40).map(|i| {
            let t = f64::from(i % 10) / 10.0;
            [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]][i as usize / 10]
        });
        assert!(matches!(error(square.collect()), ShapeError::RoughPoints { .. }));
    }
}
