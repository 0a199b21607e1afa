//! The distance of two states of the same flow: `THEORY.md`, eq. (I8).

use super::super::floors::LEAST_PART_OF_DENSITY;
use super::super::record::Frame;
use super::curve_distance::{Curve, distances};
use crate::integrator::EnergyScale;

/// Relative errors of a state, as measured against the reference at the same time.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Largest distance of the curve from that of the reference, less the rigid motion that fits best, per length.
    pub curve: f64,
    /// Of the curvature, in L²(dσ).
    pub curvature: f64,
    /// Of each density, in L²(dσ), in the order of the scene; where that is near zero, relative to a thousandth of the largest that it
    /// was.
    pub densities: Vec<f64>,
    /// Of the energy, without constants of the motion; where that is near zero, relative to a thousandth of what was lost.
    pub energy: f64,
    /// Of the length.
    pub length: f64,
}

/// What the errors of a run are relative to at least, as its reference tells.
#[derive(Debug)]
pub(super) struct Floors {
    energy: EnergyScale,
    /// Of the norm of each density.
    densities: Vec<f64>,
}

impl Floors {
    /// Those of a run from `start` with `later` states, whose energy has this scale. A density may be zero at the start, or later, or now and then.
    pub fn of(start: &Frame, later: &[Frame], energy: EnergyScale) -> Self {
        let largest = |density: usize| {
            let states = std::iter::once(start).chain(later);
            states.map(|frame| norm(&frame.density[density], &frame.metric)).fold(0.0, f64::max)
        };
        let densities = (0..start.density.len()).map(|density| LEAST_PART_OF_DENSITY * largest(density));
        Self { energy, densities: densities.collect() }
    }
}

impl Errors {
    /// Of `frame` against `reference`, which may have other nodes: both are interpolated to the more of them, or, unless all are
    /// equidistant, to those of the reference.
    pub(super) fn of(frame: &Frame, reference: &Frame, floors: &Floors) -> Self {
        let [frame, reference] = &on_common_nodes(frame, reference);
        let l2 = |values: &[f64], exact: &[f64], floor| relative_l2(values, exact, &reference.metric, floor);
        let distances = distances(&Curve::new(frame), &Curve::new(reference));
        let densities = frame.density.iter().zip(&reference.density).zip(&floors.densities);
        let energy_scale = floors.energy.with_loss(reference.energy);
        Self {
            curve: distances.into_iter().fold(0.0, larger) / reference.length,
            // No floor: a closed curve turns by 2π at least, forth or back, so that ‖κ‖ ≥ 2π/√L.
            curvature: l2(&frame.curvature, &reference.curvature, 0.0),
            densities: densities.map(|((values, exact), floor)| l2(values, exact, *floor)).collect(),
            energy: relative(frame.energy - reference.energy, energy_scale),
            length: relative(frame.length - reference.length, reference.length),
        }
    }

    /// All of them with their names, densities by those in `densities`.
    pub fn named<'a>(&self, densities: &'a [String]) -> impl Iterator<Item = (&'a str, f64)> {
        let pointwise = densities.iter().map(String::as_str).zip(self.densities.clone());
        [("curve", self.curve), ("curvature", self.curvature)]
            .into_iter()
            .chain(pointwise)
            .chain([("energy", self.energy), ("length", self.length)])
    }

    /// The largest of them.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let others = [self.curve, self.curvature, self.energy, self.length];
        others.into_iter().chain(self.densities.iter().copied()).fold(0.0, larger)
    }
}

/// Two frames at equal fractions of the arc length.
fn on_common_nodes(frame: &Frame, reference: &Frame) -> [Frame; 2] {
    let count = frame.curvature.len().max(reference.curvature.len());
    let both = [frame, reference].map(Frame::clone);
    if frame.is_uniform() && reference.is_uniform() {
        return both.map(|frame| frame.resampled(count));
    }
    let [frame, reference] = both;
    let moved = reference.fractions().and_then(|fractions| frame.clone().at_fractions(&fractions));
    // A metric that is not positive has no fractions: the parameters are the best there is.
    match moved {
        Some(frame) => [frame, reference],
        None => [frame, reference].map(|frame| frame.resampled(count)),
    }
}

/// The larger of two errors; NaN, which no bound holds, is the largest.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The size of a difference in units of `scale`; itself where that is zero.
fn relative(difference: f64, scale: f64) -> f64 {
    if scale == 0.0 { difference.abs() } else { (difference / scale).abs() }
}

/// ‖a − b‖ in units of ‖b‖, of `floor` at least.
fn relative_l2(values: &[f64], exact: &[f64], metric: &[f64], floor: f64) -> f64 {
    let difference: Vec<f64> = values.iter().zip(exact).map(|(value, exact)| value - exact).collect();
    relative(norm(&difference, metric), larger(norm(exact, metric), floor))
}

/// ‖a‖ in L²(dσ).
fn norm(values: &[f64], metric: &[f64]) -> f64 {
    let squares = metric.iter().zip(values).map(|(metric, value)| metric * value.powi(2));
    (squares.sum::<f64>() / metric.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A circle with the density 1 + a cos 2πs.
    fn circle(nodes: usize, radius: f64, amplitude: f64) -> Frame {
        let angle = |i: usize| TAU * i as f64 / nodes as f64;
        Frame {
            energy: std::f64::consts::PI / radius,
            length: TAU * radius,
            curvature: vec![1.0 / radius; nodes],
            metric: vec![TAU * radius; nodes],
            position: (0..nodes).map(|i| [radius * angle(i).cos(), radius * angle(i).sin()]).collect(),
            density: vec![(0..nodes).map(|i| 1.0 + amplitude * angle(i).cos()).collect()],
            ..Frame::default()
        }
    }

    #[test]
    fn errors_of_circles_are_those_of_their_radii() {
        let floors = Floors::of(&circle(64, 1.0, 0.0), &[], EnergyScale::new(4.0, 0.0));
        for nodes in [32, 64, 96] {
            let errors = Errors::of(&circle(64, 1.001, 0.0), &circle(nodes, 1.0, 0.01), &floors);
            assert!((errors.curve - 1e-3 / TAU).abs() < 1e-14, "{errors:?}");
            assert!((errors.curvature - 1e-3 / 1.001).abs() < 1e-13, "{errors:?}");
            assert!((errors.energy - 1e-3 / 1.001).abs() < 1e-13, "{errors:?}");
            assert!((errors.length - 1e-3).abs() < 1e-13, "{errors:?}");
            let exact = 0.01 * 0.5_f64.sqrt() / (1.0 + 0.5e-4_f64).sqrt();
            assert!((errors.densities[0] - exact).abs() < 1e-13, "{errors:?}");
            assert_eq!(errors.largest(), errors.densities[0]);
        }
    }

    #[test]
    fn what_is_zero_has_an_absolute_error() {
        let empty =
            |density: f64| Frame { energy: 0.0, density: vec![vec![density; 32]], ..circle(32, 1.0, 0.0) };
        let floors = Floors::of(&empty(0.0), &[empty(0.0)], EnergyScale::new(0.0, 0.0));
        assert_eq!(Errors::of(&empty(0.0), &empty(0.0), &floors).energy, 0.0);
        let errors = Errors::of(&empty(1e-3), &empty(0.0), &floors);
        // In L²(dσ) of a curve of length 2π.
        assert!((errors.densities[0] - 1e-3 * TAU.sqrt()).abs() < 1e-15, "{errors:?}");
    }

    #[test]
    fn a_density_near_zero_is_measured_by_the_largest_that_it_was() {
        let of = |density: f64| Frame { density: vec![vec![density; 32]], ..circle(32, 1.0, 0.0) };
        // It decays, it grows from nothing, or it comes and goes.
        for states in [[0.8, 1e-3, 1e-12], [0.0, 0.8, 1e-12], [1e-12, 0.3, 0.8]] {
            let [start, later @ ..] = states.map(of);
            let floors = Floors::of(&start, &later, EnergyScale::new(4.0, 0.0));
            for exact in states {
                let found = Errors::of(&of(exact + 1e-6), &of(exact), &floors).densities[0];
                let expected = 1e-6 / exact.max(0.8e-3);
                assert!((found / expected - 1.0).abs() < 1e-9, "{exact} of {states:?}: {found:.3e}");
            }
        }
    }

    #[test]
    fn a_state_that_is_no_number_has_the_largest_error() {
        let errors =
            Errors { curve: 0.0, curvature: f64::NAN, densities: vec![1.0], energy: 2.0, length: 0.0 };
        assert!(errors.largest().is_nan());
    }
}
