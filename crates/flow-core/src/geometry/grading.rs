//! Graded arc length: nodes of the fixed metric g = |Γ|w(s) instead of the uniform one. See `THEORY.md`, eq. (D8).

use super::grading_error::GradingError;
use super::grid::{Complex64, PeriodicGrid};
use super::vectors::{mean, mean_of_product, multiply, scale};

/// Largest error, relative to the value, of the grading interpolated to the midpoints.
const RESOLVED: f64 = 1e-2;

/// The positive weight w(s) of mean 1 at n nodes sᵢ = i/n and at the n midpoints after them.
///
/// The arc length from node 0 to node i is |Γ|xᵢ with xᵢ = ∫₀^{sᵢ} w ds, by the Fourier antiderivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Grading {
    weight: Vec<f64>,
    inverse: Vec<f64>,
    at_midpoints: Vec<f64>,
    inverse_at_midpoints: Vec<f64>,
    midpoint_mean: f64,
    inverse_square_mean: f64,
    /// x − s at the nodes, and its mean over the curve.
    shift: Vec<f64>,
    mean_shift: f64,
}

impl Grading {
    /// Fewest nodes that may be graded.
    pub const FEWEST_NODES: usize = 2;

    /// Number of samples for `nodes` nodes, at s = i/(2 `nodes`).
    #[must_use]
    pub fn samples(nodes: usize) -> usize {
        2 * nodes
    }

    /// The grading with the values `samples` at s = i/(2n), an even number of them, normalised to mean 1 over the nodes.
    ///
    /// # Errors
    /// [`GradingError`] if their number is odd or less than 4, a value is not positive, or n nodes do not resolve them.
    pub fn new(samples: &[f64]) -> Result<Self, GradingError> {
        let nodes = samples.len() / 2;
        if nodes < Self::FEWEST_NODES || samples.len() != Self::samples(nodes) {
            return Err(GradingError::Samples { samples: samples.len() });
        }
        // In units of a power of two near the largest, which is exact, so that no sum overflows.
        let largest = samples.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
        let unit = largest.log2().floor().min(1023.0).exp2();
        let relative: Vec<f64> = samples.iter().map(|value| value / unit).collect();
        if let Some(at) = relative.iter().position(|value| !(*value > f64::EPSILON && value.is_finite())) {
            return Err(GradingError::NotPositive {
                parameter: at as f64 / samples.len() as f64,
                value: samples[at],
            });
        }
        let mut weight: Vec<f64> = relative.iter().copied().step_by(2).collect();
        let mut at_midpoints: Vec<f64> = relative.iter().copied().skip(1).step_by(2).collect();
        let total = 1.0 / mean(&weight);
        scale(&mut weight, total);
        scale(&mut at_midpoints, total);
        let mut grid = PeriodicGrid::new(nodes);
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(&weight, &mut spectrum);
        let mut shift = grid.at_midpoints(&spectrum);
        for (i, (between, value)) in shift.iter().zip(&at_midpoints).enumerate() {
            let error = (between / value - 1.0).abs();
            if error > RESOLVED {
                let parameter = (i as f64 + 0.5) / nodes as f64;
                return Err(GradingError::NotResolved { nodes, parameter, error, bound: RESOLVED });
            }
        }
        grid.integrate(&mut spectrum);
        grid.synthesise(&spectrum, &mut shift);
        let first = shift[0];
        for x in &mut shift {
            *x -= first;
        }
        let reciprocal = |values: &[f64]| -> Vec<f64> { values.iter().map(|w| 1.0 / w).collect() };
        let inverse = reciprocal(&weight);
        Ok(Self {
            midpoint_mean: mean(&at_midpoints),
            inverse_square_mean: mean_of_product(&inverse, &inverse),
            mean_shift: mean_of_product(&weight, &shift),
            shift,
            inverse_at_midpoints: reciprocal(&at_midpoints),
            at_midpoints,
            inverse,
            weight,
        })
    }

    /// The uniform grading, to be set by [`Grading::set`].
    #[must_use]
    pub fn uniform(nodes: usize) -> Self {
        let (zero, one) = (vec![0.0; nodes], vec![1.0; nodes]);
        Self {
            weight: one.clone(),
            inverse: one.clone(),
            at_midpoints: one.clone(),
            inverse_at_midpoints: one,
            midpoint_mean: 1.0,
            inverse_square_mean: 1.0,
            shift: zero,
            mean_shift: 0.0,
        }
    }

    /// Takes the metric with the Fourier coefficients `metric`, whose interpolation to the midpoints has the symbol
    /// `interpolation`; `scratch` is one spectrum. A metric that is not positive has reciprocals that are not numbers.
    pub fn set(
        &mut self,
        metric: &[Complex64],
        interpolation: &[Complex64],
        grid: &mut PeriodicGrid,
        scratch: &mut [Complex64],
    ) {
        let length = metric[0].re;
        scratch.iter_mut().zip(metric).for_each(|(w, g)| *w = g / length);
        grid.synthesise(scratch, &mut self.weight);
        scratch.iter_mut().zip(metric).zip(interpolation).for_each(|((w, g), m)| *w = g * m / length);
        grid.synthesise(scratch, &mut self.at_midpoints);
        let reciprocal = |w: &f64| if *w > 0.0 { 1.0 / w } else { f64::NAN };
        self.inverse.iter_mut().zip(&self.weight).for_each(|(inverse, w)| *inverse = reciprocal(w));
        let midpoints = self.inverse_at_midpoints.iter_mut().zip(&self.at_midpoints);
        midpoints.for_each(|(inverse, w)| *inverse = reciprocal(w));
        scratch.iter_mut().zip(metric).for_each(|(w, g)| *w = g / length);
        grid.integrate(scratch);
        grid.synthesise(scratch, &mut self.shift);
        let first = self.shift[0];
        self.shift.iter_mut().for_each(|x| *x -= first);
        self.midpoint_mean = mean(&self.at_midpoints);
        self.inverse_square_mean = mean_of_product(&self.inverse, &self.inverse);
        self.mean_shift = mean_of_product(&self.weight, &self.shift);
    }

    /// Takes the values of `other`, on as many nodes, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        for (to, from) in [
            (&mut self.weight, &other.weight),
            (&mut self.inverse, &other.inverse),
            (&mut self.at_midpoints, &other.at_midpoints),
            (&mut self.inverse_at_midpoints, &other.inverse_at_midpoints),
            (&mut self.shift, &other.shift),
        ] {
            to.copy_from_slice(from);
        }
        self.midpoint_mean = other.midpoint_mean;
        self.inverse_square_mean = other.inverse_square_mean;
        self.mean_shift = other.mean_shift;
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.weight.len()
    }

    /// w at the nodes: the weights of means over the curve.
    #[must_use]
    pub fn weight(&self) -> &[f64] {
        &self.weight
    }

    /// 1/w at the nodes.
    #[must_use]
    pub fn inverse(&self) -> &[f64] {
        &self.inverse
    }

    /// w at the midpoints.
    #[must_use]
    pub fn at_midpoints(&self) -> &[f64] {
        &self.at_midpoints
    }

    /// 1/w at the midpoints.
    #[must_use]
    pub fn inverse_at_midpoints(&self) -> &[f64] {
        &self.inverse_at_midpoints
    }

    /// Mean of w over the midpoints: 1 up to what the grid does not resolve.
    #[must_use]
    pub fn midpoint_mean(&self) -> f64 {
        self.midpoint_mean
    }

    /// Mean over the nodes of w⁻², the coefficient of `Δ_s` with its variation left out.
    #[must_use]
    pub fn inverse_square_mean(&self) -> f64 {
        self.inverse_square_mean
    }

    /// Fractions xᵢ of the arc length at the nodes, x₀ = 0.
    #[must_use]
    pub fn fractions(&self) -> Vec<f64> {
        let count = self.nodes() as f64;
        self.shift.iter().enumerate().map(|(i, shift)| i as f64 / count + shift).collect()
    }

    /// x − s at the nodes.
    #[must_use]
    pub fn shift(&self) -> &[f64] {
        &self.shift
    }

    /// Mean of x − s over the curve.
    #[must_use]
    pub fn mean_shift(&self) -> f64 {
        self.mean_shift
    }

    /// w at any parameter, by linear interpolation.
    #[must_use]
    pub fn at(&self, parameter: f64) -> f64 {
        let count = 2 * self.nodes();
        let place = (parameter * count as f64).rem_euclid(count as f64);
        let (left, part) = (place as usize % count, place.fract());
        let sample = |i: usize| {
            let i = i % count;
            if i.is_multiple_of(2) { self.weight[i / 2] } else { self.at_midpoints[i / 2] }
        };
        (1.0 - part) * sample(left) + part * sample(left + 1)
    }

    /// 1/w at node `node` of `nodes` equidistant ones, which need not be those of the grading, times 1/w halfway to the
    /// node before and halfway to the one after: the coefficients of `Δ_s` by second differences.
    #[must_use]
    pub fn spacing(&self, node: usize, nodes: usize) -> [f64; 2] {
        if nodes == self.nodes() {
            let midpoints = [(node + nodes - 1) % nodes, node];
            return midpoints.map(|i| self.inverse[node] * self.inverse_at_midpoints[i]);
        }
        let at = |shift: f64| self.at((node as f64 + shift) / nodes as f64);
        [-0.5, 0.5].map(|shift| 1.0 / (at(0.0) * at(shift)))
    }

    /// Multiplies consecutive nodal fields by w: from pointwise values to values per unit parameter and length.
    pub fn weigh(&self, fields: &mut [f64]) {
        for field in fields.chunks_exact_mut(self.nodes()) {
            multiply(field, &self.weight);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn samples(nodes: usize, amplitude: f64) -> Vec<f64> {
        (0..2 * nodes).map(|i| 3.0 + amplitude * (TAU * i as f64 / (2 * nodes) as f64).cos()).collect()
    }

    #[test]
    fn it_has_mean_one_and_adds_up_to_fractions_of_the_length() {
        for nodes in [32, 45] {
            let grading = Grading::new(&samples(nodes, 1.5)).unwrap();
            assert!((mean(grading.weight()) - 1.0).abs() < 1e-15);
            let exact = |s: f64| s + 0.5 * (TAU * s).sin() / TAU;
            let places = grading.fractions().into_iter().zip(grading.midpoint_fractions());
            for (i, (x, halfway)) in places.enumerate() {
                let s = i as f64 / nodes as f64;
                assert!((x - exact(s)).abs() < 1e-15, "{x}");
                assert!((halfway - exact(s + 0.5 / nodes as f64)).abs() < 1e-14, "{halfway}");
            }
            assert!((grading.at(0.25) - 1.0).abs() < 1e-2);
        }
    }

    #[test]
    fn it_must_be_positive_and_resolved() {
        assert!(
            matches!(Grading::new(&samples(32, 4.0)), Err(GradingError::NotPositive { value, .. }) if value < 0.0)
        );
        let mut vanishing = samples(32, 0.0);
        (vanishing[3], vanishing[8]) = (1e308, f64::INFINITY);
        assert!(matches!(Grading::new(&vanishing), Err(GradingError::NotPositive { value: 3.0, .. })));
        vanishing[3] = 3.0;
        assert!(matches!(
            Grading::new(&vanishing),
            Err(GradingError::NotPositive { value: f64::INFINITY, .. })
        ));
        for size in [5e-324, 2f64.powi(1023)] {
            assert_eq!(Grading::new(&[size; 64]).unwrap(), Grading::new(&[1.0; 64]).unwrap());
        }
        let mut rough = samples(32, 0.0);
        rough[9] = 5.0;
        assert!(matches!(Grading::new(&rough), Err(GradingError::NotResolved { nodes: 32, .. })));
    }
}
