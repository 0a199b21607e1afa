//! Nodes at given fractions of the arc length, σ(φᵢ) = xᵢ|Γ|, and what the state of a curve needs there.

use std::f64::consts::TAU;

use super::arc_length::ArcLength;
use super::curve::Curve;
use super::error::ShapeError;
use super::jet::{Jet, acceleration, speed, turning};
use super::quadrature::{POINTS, mean};
use crate::geometry::Grading;

/// A curve at n nodes of equal or graded arc length; node 0 is γ(φ = 0).
#[derive(Clone, Debug, PartialEq)]
pub struct Resampled {
    /// Curvature κ at the nodes, positive on a circle.
    pub curvature: Vec<f64>,
    /// Length |Γ|.
    pub length: f64,
    /// Turning number ω ≥ 0: turns of the tangent along the curve.
    pub turning_number: i32,
    /// Mean over the curve of θ − 2πωx, as in [`Placement`](crate::geometry::Placement).
    pub angle: f64,
    /// Mean position of the curve.
    pub centre: [f64; 2],
    /// Position γ of the nodes.
    pub position: Vec<[f64; 2]>,
    /// Parameter φ/2π of the nodes, in [0, 1).
    pub parameter: Vec<f64>,
}

/// A curve by its arc length, which is integrated once for all nodes that it gets.
#[derive(Debug)]
pub struct ByArcLength {
    curve: Curve,
    arc_length: ArcLength,
}

impl ByArcLength {
    pub(super) fn new(curve: Curve) -> Result<Self, ShapeError> {
        Ok(Self { arc_length: ArcLength::of(&curve)?, curve })
    }

    /// The length |Γ|, to a relative 1e-12.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc_length.total()
    }

    /// The curve at `nodes` nodes, as [`Shape::resample`](super::Shape::resample).
    ///
    /// # Errors
    /// [`ShapeError::NotResolved`] if a node is lost in a cell.
    /// # Panics
    /// If `nodes` is 0.
    pub fn resample(&self, nodes: usize) -> Result<Resampled, ShapeError> {
        assert!(nodes > 0, "a curve has at least one node");
        let fractions: Vec<f64> = (0..nodes).map(|i| i as f64 / nodes as f64).collect();
        self.at(&fractions)
    }

    /// The curve at graded nodes; node 0 is γ(φ = 0).
    ///
    /// # Errors
    /// As [`resample`](Self::resample).
    pub fn resample_graded(&self, grading: &Grading) -> Result<Resampled, ShapeError> {
        self.weighted(&grading.fractions(), Some(grading.weight()))
    }

    /// The curve at the `fractions` of its arc length, each in [0, 1); its angle and centre are means over these points.
    ///
    /// # Errors
    /// As [`resample`](Self::resample).
    pub fn at(&self, fractions: &[f64]) -> Result<Resampled, ShapeError> {
        self.weighted(fractions, None)
    }

    /// `weight` holds the weights of the nodes in means over the curve, if they are not all 1.
    fn weighted(&self, fractions: &[f64], weight: Option<&[f64]>) -> Result<Resampled, ShapeError> {
        let Self { curve, arc_length } = self;
        let nodes = fractions.len();
        let places = invert(curve, arc_length, fractions)?;
        let phi: Vec<f64> = places.iter().map(|place| place.phi(arc_length)).collect();
        let jets = curve.jets(&phi);
        let turns = f64::from(arc_length.turning_number);
        let weight = |i: usize| weight.map_or(1.0, |weight| weight[i]);
        let angle = |(i, (place, jet))| {
            weight(i) * (tangent_angle(arc_length, place, jet) - TAU * turns * fractions[i])
        };
        let mean_of = |axis: usize| {
            let positions = jets.iter().enumerate().map(|(i, [position, ..])| weight(i) * position[axis]);
            positions.sum::<f64>() / nodes as f64
        };
        Ok(Resampled {
            curvature: jets.iter().map(|jet| (jet, speed(jet))).map(|(jet, v)| turning(jet, v) / v).collect(),
            length: arc_length.total(),
            turning_number: arc_length.turning_number,
            angle: places.iter().zip(&jets).enumerate().map(angle).sum::<f64>() / nodes as f64,
            centre: [mean_of(0), mean_of(1)],
            position: jets.iter().map(|[position, ..]| *position).collect(),
            parameter: phi.iter().map(|phi| phi / TAU).collect(),
        })
    }
}

/// The tangent angle at a node, on the branch that continues from φ = 0.
fn tangent_angle(arc_length: &ArcLength, place: &Place, [_, tangent, _]: &Jet) -> f64 {
    let theta = tangent[1].atan2(tangent[0]);
    let (left, right) = (arc_length.tangent_angle[place.cell], arc_length.tangent_angle[place.cell + 1]);
    let expected = left + (right - left) * place.offset / arc_length.cell_width();
    theta + TAU * ((expected - theta) / TAU).round()
}

/// Where a node lies, while it is looked for and afterwards.
struct Place {
    cell: usize,
    /// φ − φ(left edge of the cell), between `low` and `high`.
    offset: f64,
    low: f64,
    high: f64,
    /// Arc length wanted behind the left edge.
    target: f64,
    found: bool,
}

/// Passes of the inversion; two are enough for a curve whose cells are resolved.
const MOST_PASSES: usize = 100;
/// Step, in widths of the cell, whose third power is rounding: what Halley's method leaves behind.
const LAST_STEP: f64 = 1e-6;

/// Solves σ(φᵢ) = xᵢ|Γ| for every node by Halley's method.
fn invert(curve: &Curve, arc_length: &ArcLength, fractions: &[f64]) -> Result<Vec<Place>, ShapeError> {
    let rounding = 2.0 * f64::EPSILON * arc_length.total();
    let mut places: Vec<Place> =
        fractions.iter().map(|fraction| Place::guess(arc_length, *fraction)).collect();
    for _ in 0..MOST_PASSES {
        let mut open: Vec<&mut Place> = places.iter_mut().filter(|place| !place.found).collect();
        if open.is_empty() {
            return Ok(places);
        }
        let phi: Vec<f64> = open.iter().map(|place| place.phi(arc_length)).collect();
        let jets = curve.jets(&phi);
        let lengths = partial_lengths(curve, arc_length, &open);
        for ((place, jet), length) in open.iter_mut().zip(&jets).zip(&lengths) {
            place.improve(
                length - place.target,
                rounding,
                speed(jet),
                acceleration(jet),
                arc_length.cell_width(),
            );
        }
    }
    let lost = places.iter().find(|place| !place.found).map_or(0.0, |place| place.phi(arc_length));
    let cells = arc_length.at_edges.len() - 1;
    Err(ShapeError::NotResolved { cells, phi: lost, change: arc_length.cell_width(), bound: rounding })
}

/// The arc length of every place behind the left edge of its cell, by Gauss's rule on that part of the cell.
fn partial_lengths(curve: &Curve, arc_length: &ArcLength, places: &[&mut Place]) -> Vec<f64> {
    let width = arc_length.cell_width();
    let points = |place: &&mut Place| {
        let (left, offset) = (place.cell as f64 * width, place.offset);
        POINTS.map(|x| left + offset * x)
    };
    let phi: Vec<f64> = places.iter().flat_map(points).collect();
    let speeds = curve.speeds(&phi);
    places
        .iter()
        .zip(speeds.chunks(POINTS.len()))
        .map(|(place, speeds)| place.offset * mean(speeds))
        .collect()
}

impl Place {
    /// The place at the `fraction` of the length, by Hermite's cubic for φ(σ) on its cell.
    fn guess(arc_length: &ArcLength, fraction: f64) -> Self {
        let sigma = fraction * arc_length.total();
        let (edges, width) = (&arc_length.at_edges, arc_length.cell_width());
        let cell = edges.partition_point(|&edge| edge <= sigma).clamp(1, edges.len() - 1) - 1;
        let (target, length) = (sigma - edges[cell], edges[cell + 1] - edges[cell]);
        let x = target / length;
        let [left, right] = [cell, cell + 1].map(|edge| length / arc_length.speed[edge]);
        let cubic = x * x * (3.0 - 2.0 * x) * width + x * (1.0 - x) * ((1.0 - x) * left - x * right);
        Self { cell, offset: cubic.clamp(0.0, width), low: 0.0, high: width, target, found: false }
    }

    /// The parameter φ.
    fn phi(&self, arc_length: &ArcLength) -> f64 {
        self.cell as f64 * arc_length.cell_width() + self.offset
    }

    /// One step of Halley's method, or a bisection where it leaves the bracket.
    fn improve(&mut self, residual: f64, rounding: f64, speed: f64, acceleration: f64, width: f64) {
        if residual.abs() <= rounding {
            self.found = true;
            return;
        }
        *(if residual > 0.0 { &mut self.high } else { &mut self.low }) = self.offset;
        let newton = -residual / speed;
        let step = newton / (1.0 + 0.5 * newton * acceleration / speed);
        let aim = self.offset + step;
        let inside = aim.clamp(self.low, self.high);
        if (aim - inside).abs() <= LAST_STEP * width {
            self.found = step.abs() <= LAST_STEP * width;
            self.offset = inside;
        } else {
            self.offset = 0.5 * (self.low + self.high);
        }
    }
}
