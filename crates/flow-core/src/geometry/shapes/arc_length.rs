//! Arc length and turning of a curve, cumulated over cells of φ that are halved until both are resolved.

use std::f64::consts::TAU;

use super::curve::Curve;
use super::error::ShapeError;
use super::jet::{Jet, speed, turning};
use super::quadrature::{POINTS, cumulative, mean};

/// What is known of a curve on its cells; edge i of c is φ = 2πi/c.
#[derive(Debug)]
pub(super) struct ArcLength {
    /// Arc length from φ = 0 to every edge, 2π included.
    pub(super) at_edges: Vec<f64>,
    /// Tangent angle at every edge, without jumps.
    pub(super) tangent_angle: Vec<f64>,
    /// Speed |γ′| at every edge.
    pub(super) speed: Vec<f64>,
    /// Turning number, 0 or more.
    pub(super) turning_number: i32,
}

/// Largest change of the length, relative to it, that the last halving of the cells may make.
const RESOLVED: f64 = 1e-12;
/// Cells at which halving ends.
const MOST_CELLS: usize = 1 << 15;
/// Distance of the number of turns from a whole number.
const WHOLE: f64 = 1e-6;
/// Gap of the ends relative to the length; of their derivatives relative to the mean speed.
const CLOSED: f64 = 1e-9;
/// Length, relative to the distance from the origin, below which a curve is a point.
const POINT: f64 = 1e-13;
/// Speed, relative to the mean, that is zero wherever it is met, and that explains why cells do not resolve it.
const STANDSTILL: f64 = 1e-12;
const NEAR_STANDSTILL: f64 = 1e-4;
/// Distance in φ from a standstill at which cells are not resolved because of it.
const NEAR: f64 = 0.1;

impl ArcLength {
    /// Integrates along `curve`.
    pub(super) fn of(curve: &Curve) -> Result<Self, ShapeError> {
        let mut cells = curve.fewest_cells();
        let most_cells = MOST_CELLS.max(16 * cells);
        let mut coarse = Level::new(curve, cells)?;
        coarse.check_length()?;
        check_closed(curve, coarse.total_length())?;
        loop {
            coarse.check_speed(STANDSTILL)?;
            cells *= 2;
            let fine = Level::new(curve, cells)?;
            let whole = (fine.turns() - fine.turns().round()).abs() <= WHOLE;
            let resolution = coarse.compare(&fine);
            if whole && resolution.is_ok() {
                fine.check_speed(STANDSTILL)?;
                return fine.finish();
            }
            if cells >= most_cells {
                if resolution.as_ref().err().is_none_or(|error| fine.stops_near(error)) {
                    fine.check_speed(NEAR_STANDSTILL)?;
                }
                resolution?;
                return Err(ShapeError::Corner { turns: fine.turns(), bound: WHOLE });
            }
            coarse = fine;
        }
    }

    /// The length of the curve.
    pub(super) fn total(&self) -> f64 {
        self.at_edges[self.at_edges.len() - 1]
    }

    /// Width of a cell in φ.
    pub(super) fn cell_width(&self) -> f64 {
        TAU / (self.at_edges.len() - 1) as f64
    }
}

/// The integrals over equal cells.
struct Level {
    length: Vec<f64>,
    turning: Vec<f64>,
    speed_at_edges: Vec<f64>,
    first_tangent_angle: f64,
    /// Largest distance of a sample from one of the axes.
    extent: f64,
    /// Smallest speed and its φ.
    slowest: (f64, f64),
}

impl Level {
    fn new(curve: &Curve, cells: usize) -> Result<Self, ShapeError> {
        let width = TAU / cells as f64;
        // Every cell has its left edge first, then the points of the rule.
        let points = || std::iter::once(0.0).chain(POINTS);
        let phi: Vec<f64> =
            (0..cells).flat_map(|cell| points().map(move |x| (cell as f64 + x) * width)).collect();
        let jets = curve.jets(&phi);
        check_finite(&phi, &jets)?;
        let speeds: Vec<f64> = jets.iter().map(speed).collect();
        let turnings: Vec<f64> = jets.iter().zip(&speeds).map(|(jet, v)| turning(jet, *v)).collect();
        let integrals =
            |values: &[f64]| values.chunks(1 + POINTS.len()).map(|cell| width * mean(&cell[1..])).collect();
        let slowest = speeds.iter().zip(&phi).min_by(|a, b| a.0.total_cmp(b.0));
        Ok(Self {
            length: integrals(&speeds),
            turning: integrals(&turnings),
            speed_at_edges: speeds.iter().step_by(1 + POINTS.len()).copied().collect(),
            first_tangent_angle: jets[0][1][1].atan2(jets[0][1][0]),
            extent: jets
                .iter()
                .flat_map(|[position, ..]| position)
                .fold(0.0, |most: f64, x| most.max(x.abs())),
            slowest: slowest.map_or((0.0, 0.0), |(&speed, &phi)| (speed, phi)),
        })
    }

    fn total_length(&self) -> f64 {
        self.length.iter().sum()
    }

    /// Whole turns of the tangent, with a sign.
    fn turns(&self) -> f64 {
        self.turning.iter().sum::<f64>() / TAU
    }

    /// The curve must be longer than rounding.
    fn check_length(&self) -> Result<(), ShapeError> {
        let (length, bound) = (self.total_length(), POINT * self.extent);
        if length > bound { Ok(()) } else { Err(ShapeError::ZeroLength { length, bound }) }
    }

    /// The speed must exceed `bound` of its mean.
    fn check_speed(&self, bound: f64) -> Result<(), ShapeError> {
        let ((speed, phi), bound) = (self.slowest, bound * self.total_length() / TAU);
        if speed > bound { Ok(()) } else { Err(ShapeError::Stops { phi, speed, bound }) }
    }

    /// Whether the slowest point explains why cells are not resolved; far from them it does not: they hold a pole.
    fn stops_near(&self, unresolved: &ShapeError) -> bool {
        let ShapeError::NotResolved { phi, .. } = unresolved else { return false };
        let distance = (phi - self.slowest.1).abs();
        distance.min(TAU - distance) < NEAR
    }

    /// Compares every cell with its halves: in the total alone the errors of cells can cancel.
    fn compare(&self, halves: &Self) -> Result<(), ShapeError> {
        let change = |(whole, halves): (&f64, &[f64])| (whole - halves[0] - halves[1]).abs();
        let changes: Vec<f64> = self.length.iter().zip(halves.length.chunks(2)).map(change).collect();
        let (bound, cells) = (RESOLVED * halves.total_length(), halves.length.len());
        if changes.iter().sum::<f64>() <= bound {
            return Ok(());
        }
        let worst = changes.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        let (cell, change) = worst.map_or((0, 0.0), |(cell, &change)| (cell, change));
        let phi = TAU * (cell as f64 + 0.5) / changes.len() as f64;
        Err(ShapeError::NotResolved { cells, phi, change, bound })
    }

    fn finish(self) -> Result<ArcLength, ShapeError> {
        let turning_number = self.turns().round() as i32;
        if turning_number < 0 {
            return Err(ShapeError::Clockwise { turning_number });
        }
        let mut speed = self.speed_at_edges;
        speed.push(speed[0]);
        let mut tangent_angle = cumulative(self.turning.into_iter());
        for theta in &mut tangent_angle {
            *theta += self.first_tangent_angle;
        }
        let at_edges = cumulative(self.length.into_iter());
        Ok(ArcLength { at_edges, tangent_angle, speed, turning_number })
    }
}

fn check_finite(phi: &[f64], jets: &[Jet]) -> Result<(), ShapeError> {
    for (&phi, jet) in phi.iter().zip(jets) {
        for (order, components) in jet.iter().enumerate() {
            if let Some(axis) = components.iter().position(|value| !value.is_finite()) {
                return Err(ShapeError::NotFinite { order, axis, phi, value: components[axis] });
            }
        }
    }
    Ok(())
}

/// Position and derivative at 2π must be those at 0.
fn check_closed(curve: &Curve, length: f64) -> Result<(), ShapeError> {
    let ends = [0.0, TAU];
    let jets = curve.jets(&ends);
    check_finite(&ends, &jets)?;
    for (order, size) in [length, length / TAU].into_iter().enumerate() {
        let [[x, y], [other_x, other_y]] = [jets[0][order], jets[1][order]];
        let (gap, bound) = ((other_x - x).hypot(other_y - y), CLOSED * size);
        // Written so that NaN is a gap.
        if !matches!(gap.partial_cmp(&bound), Some(std::cmp::Ordering::Less | std::cmp::Ordering::Equal)) {
            return Err(ShapeError::NotClosed { order, gap, bound });
        }
    }
    Ok(())
}
