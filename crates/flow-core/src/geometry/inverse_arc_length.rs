//! Where on graded nodes given fractions of the arc length are reached.

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};
use super::scattered_points::ScatteredPoints;

/// Passes of Newton's method; the start is within the sixth power of a node distance.
const MOST_PASSES: usize = 8;
/// Error of the fraction of the arc length that the next pass brings to rounding.
const FOUND: f64 = 1e-8;

impl ScatteredPoints {
    /// The parameters of the nodes of `grading` where the `fractions` of the arc length are reached, by Newton's method within the
    /// interval between two nodes.
    #[must_use]
    pub fn at_fractions(grading: &Grading, fractions: &[f64]) -> Self {
        let nodes = grading.nodes();
        let mut grid = PeriodicGrid::new(nodes);
        let mut spectra =
            [vec![Complex64::default(); grid.modes()], vec![Complex64::default(); grid.modes()]];
        grid.transform(grading.shift(), &mut spectra[0]);
        grid.transform(grading.weight(), &mut spectra[1]);
        let starts = Starts::new(grading, &mut grid, &spectra[1]);
        let mut intervals = Vec::with_capacity(fractions.len());
        let mut found = Vec::with_capacity(fractions.len());
        let mut left = 0;
        for x in fractions {
            left = starts.interval(*x, left);
            let [low, high] = [left, left + 1].map(|i| i as f64 / nodes as f64);
            intervals.push([low, high]);
            found.push(starts.guess(*x, left).clamp(low, high));
        }
        let mut points = Self::new(nodes, &found);
        for _ in 0..MOST_PASSES {
            let [shifts, slopes] = spectra.each_ref().map(|spectrum| points.values(spectrum));
            let mut worst = 0.0_f64;
            for (i, s) in found.iter_mut().enumerate() {
                let excess = *s + shifts[i] - fractions[i];
                worst = worst.max(excess.abs());
                intervals[i][usize::from(excess > 0.0)] = *s;
                let [low, high] = intervals[i];
                let aim = *s - excess / slopes[i];
                // A node itself may be the solution, to rounding.
                *s = if (low..=high).contains(&aim) { aim } else { 0.5 * (low + high) };
            }
            points.move_to(&found);
            if worst <= FOUND {
                break;
            }
        }
        points
    }
}

/// The parameter s as a function of the fraction x of the arc length, between the nodes by Hermite's polynomials of degree five.
struct Starts {
    /// x at the nodes, and at the first one again.
    fractions: Vec<f64>,
    /// ds/dx and d²s/dx² there.
    derivatives: Vec<[f64; 2]>,
}

impl Starts {
    /// Of `grading`, whose weight has the Fourier coefficients `weight`.
    fn new(grading: &Grading, grid: &mut PeriodicGrid, weight: &[Complex64]) -> Self {
        let mut spectrum: Vec<Complex64> = weight.to_vec();
        for (mode, value) in spectrum.iter_mut().enumerate() {
            *value *= Complex64::new(0.0, grid.wave_number(mode));
        }
        let mut slopes = vec![0.0; grading.nodes()];
        grid.synthesise(&spectrum, &mut slopes);
        // s′ = 1/w, s″ = −w′/w³.
        let derivative = |(inverse, slope): (&f64, &f64)| [*inverse, -slope * inverse.powi(3)];
        let mut derivatives: Vec<[f64; 2]> = grading.inverse().iter().zip(&slopes).map(derivative).collect();
        derivatives.extend_from_within(..1);
        let mut fractions = grading.fractions();
        fractions.push(1.0);
        Self { fractions, derivatives }
    }

    /// The node before the fraction `x`; `near` is a guess.
    fn interval(&self, x: f64, near: usize) -> usize {
        let last = self.fractions.len() - 2;
        for left in near..(near + 3).min(last) {
            if (self.fractions[left]..self.fractions[left + 1]).contains(&x) {
                return left;
            }
        }
        self.fractions[..=last].partition_point(|at| *at <= x).max(1) - 1
    }

    /// The parameter at the fraction `x` after the node `left`.
    fn guess(&self, x: f64, left: usize) -> f64 {
        let [start, end] = [left, left + 1].map(|i| self.fractions[i]);
        let length = end - start;
        let distance = 1.0 / (self.fractions.len() - 1) as f64;
        // What is left of s beside the straight line: its first and second derivatives at both ends.
        let slope = |i: usize| length * self.derivatives[i][0] - distance;
        let bend = |i: usize| length * length * self.derivatives[i][1];
        let ([a, b], [p, q]) = ([left, left + 1].map(slope), [left, left + 1].map(bend));
        let (rise, turn, change) = (-(a + 0.5 * p), b - a - p, q - p);
        let cubic = 10.0 * rise - 4.0 * turn + 0.5 * change;
        let quartic = -15.0 * rise + 7.0 * turn - change;
        let quintic = 6.0 * rise - 3.0 * turn + 0.5 * change;
        let t = (x - start) / length;
        (left as f64 + t) * distance + t * (a + t * (0.5 * p + t * (cubic + t * (quartic + t * quintic))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// x = s + 0.13 sin 2πs.
    #[test]
    fn the_fractions_of_the_arc_length_are_reached() {
        let samples = |nodes: usize| -> Vec<f64> {
            (0..2 * nodes).map(|i| 1.0 + 0.13 * TAU * (TAU * i as f64 / (2 * nodes) as f64).cos()).collect()
        };
        for nodes in [32, 45, 384] {
            let grading = Grading::new(&samples(nodes)).unwrap();
            let fractions: Vec<f64> =
                (0..100).map(|i| 0.0099 * f64::from(i)).rev().chain([0.0, 1.0]).collect();
            let mut points = ScatteredPoints::at_fractions(&grading, &fractions);
            let mut grid = PeriodicGrid::new(nodes);
            let wave: Vec<f64> = (0..nodes).map(|i| (TAU * i as f64 / nodes as f64).sin()).collect();
            let mut spectrum = vec![Complex64::default(); grid.modes()];
            grid.transform(&wave, &mut spectrum);
            // sin 2πs by Newton's method for s.
            for (x, value) in fractions.iter().zip(points.values(&spectrum)) {
                let mut s = *x;
                for _ in 0..50 {
                    s -= (s + 0.13 * (TAU * s).sin() - x) / (1.0 + 0.13 * TAU * (TAU * s).cos());
                }
                assert!((value - (TAU * s).sin()).abs() < 2e-13, "{nodes} nodes, x = {x}: {value}");
            }
        }
    }

    #[test]
    fn the_start_has_an_error_of_order_six() {
        let error = |nodes: usize| {
            let samples: Vec<f64> = (0..2 * nodes)
                .map(|i| 1.0 + 0.13 * TAU * (TAU * i as f64 / (2 * nodes) as f64).cos())
                .collect();
            let grading = Grading::new(&samples).unwrap();
            let mut grid = PeriodicGrid::new(nodes);
            let mut spectrum = vec![Complex64::default(); grid.modes()];
            grid.transform(grading.weight(), &mut spectrum);
            let starts = Starts::new(&grading, &mut grid, &spectrum);
            let at = |i: u32| {
                let x = 0.00831 * f64::from(i);
                let s = starts.guess(x, starts.interval(x, 0));
                (s + 0.13 * (TAU * s).sin() - x).abs()
            };
            (0..120).map(at).fold(0.0, f64::max)
        };
        assert!(error(32) > 40.0 * error(64) && error(64) > 40.0 * error(128), "{} {}", error(32), error(64));
    }
}
