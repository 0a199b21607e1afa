//! Polynomials in stretched time as polynomials in θ, whose integrals the moments give. See `THEORY.md`, eq. (I10).

use std::f64::consts::PI;
use std::sync::LazyLock;

use multiversion::multiversion;

use super::orders::MOST_MOMENTS;
use super::polynomials::{Coefficients, lagrange_basis};
use crate::integrator::clock::stretched;

/// Points of an interpolation on [0, 1], both ends among them, and its Lagrange polynomials.
struct Interpolation {
    points: [f64; MOST_MOMENTS],
    basis: [Coefficients; MOST_MOMENTS],
}

/// Those at the extrema of Chebyshev polynomials, by their number.
static INTERPOLATIONS: LazyLock<[Interpolation; MOST_MOMENTS + 1]> = LazyLock::new(|| {
    std::array::from_fn(|count| {
        let last = count.saturating_sub(1).max(1) as f64;
        let points = std::array::from_fn(|i| 0.5 - 0.5 * (PI * i as f64 / last).cos());
        Interpolation { points, basis: lagrange_basis(&points[..count]) }
    })
});

/// The clock of one step in units of that step, u(θ) = ln(1 + xθ)/ln(1 + x), or θ if x is zero.
#[derive(Clone, Copy, Debug)]
pub struct StepClock {
    /// x, the rate of the clock times the step.
    run: f64,
    /// 1/ln(1 + x).
    scale: f64,
}

impl StepClock {
    /// For x = `run`.
    pub fn new(run: f64) -> Self {
        Self { run, scale: if run == 0.0 { 1.0 } else { 1.0 / run.ln_1p() } }
    }

    fn at(&self, theta: f64) -> f64 {
        self.scale * stretched(self.run, theta)
    }

    /// u of `times`, in steps of `size` from `start`.
    pub fn nodes(&self, times: &[f64], start: f64, size: f64) -> [f64; MOST_MOMENTS] {
        let mut nodes = [0.0; MOST_MOMENTS];
        nodes.iter_mut().zip(times).for_each(|(node, time)| *node = self.at((time - start) / size));
        nodes
    }
}

/// Polynomials in u, taken to θ.
#[derive(Clone, Debug)]
pub struct Substitution {
    clock: StepClock,
    /// Coefficients that they have in θ where u is not θ.
    terms: usize,
    /// 1, u, u², … as polynomials in θ: the interpolations converge like ρ⁻ⁿ, ρ + 1/ρ = 4/x + 2.
    powers: [Coefficients; MOST_MOMENTS],
}

impl Substitution {
    /// By polynomials of `terms` coefficients.
    pub fn new(clock: StepClock, terms: usize) -> Self {
        let mut substitution = Self { clock, terms, powers: [[0.0; MOST_MOMENTS]; MOST_MOMENTS] };
        substitution.set(clock, terms);
        substitution
    }

    /// Becomes that of another clock.
    pub fn set(&mut self, clock: StepClock, terms: usize) {
        (self.clock, self.terms) = (clock, terms);
        if clock.run != 0.0 {
            let Interpolation { points, basis } = &INTERPOLATIONS[terms];
            let values: [f64; MOST_MOMENTS] = std::array::from_fn(|i| clock.at(points[i]));
            interpolate_powers(&values[..terms], basis, &mut self.powers);
        }
    }

    /// The clock.
    pub fn clock(&self) -> StepClock {
        self.clock
    }

    /// How many coefficients a polynomial in u of `terms` coefficients has in θ.
    pub fn terms(&self, terms: usize) -> usize {
        if self.clock.run == 0.0 { terms } else { self.terms }
    }

    /// The Lagrange polynomials of `nodes`, values of u, as polynomials in θ.
    pub fn lagrange_basis(&self, nodes: &[f64]) -> [Coefficients; MOST_MOMENTS] {
        let mut basis = lagrange_basis(nodes);
        basis[..nodes.len()].iter_mut().for_each(|polynomial| self.take_to_theta(polynomial));
        basis
    }

    /// Makes a polynomial in θ of one in u.
    pub fn take_to_theta(&self, polynomial: &mut Coefficients) {
        if self.clock.run != 0.0 {
            substitute(&self.powers[..self.terms], polynomial);
        }
    }
}

/// `powers` = the polynomials in θ of the `basis` with the powers of `values` at its points.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn interpolate_powers(values: &[f64], basis: &[Coefficients], powers: &mut [Coefficients]) {
    let powers = &mut powers[..values.len()];
    powers.fill([0.0; MOST_MOMENTS]);
    for (value, polynomial) in values.iter().zip(basis) {
        let mut power = 1.0;
        for coefficients in &mut *powers {
            for k in 0..MOST_MOMENTS {
                coefficients[k] += power * polynomial[k];
            }
            power *= value;
        }
    }
}

/// The powers in place of u.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn substitute(powers: &[Coefficients], polynomial: &mut Coefficients) {
    let mut sum = [0.0; MOST_MOMENTS];
    for (coefficient, power) in polynomial.iter().zip(powers) {
        for k in 0..MOST_MOMENTS {
            sum[k] += coefficient * power[k];
        }
    }
    *polynomial = sum;
}

#[cfg(test)]
mod tests {
    use super::super::orders::{FOR_CLOCKS, HIGHEST_ORDER};
    use super::*;

    fn at(polynomial: &Coefficients, x: f64) -> f64 {
        polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    fn in_theta(substitution: &Substitution, mut polynomial: Coefficients) -> Coefficients {
        substitution.take_to_theta(&mut polynomial);
        polynomial
    }

    /// Largest error on the step of u^`degree` as a polynomial for steps of order `order`.
    fn error(run: f64, order: usize, degree: usize) -> f64 {
        let clock = StepClock::new(run);
        let mut power = [0.0; MOST_MOMENTS];
        power[degree] = 1.0;
        let polynomial = in_theta(&Substitution::new(clock, order + FOR_CLOCKS), power);
        (0..=100).map(|i| f64::from(i) / 100.0).fold(0.0, |most: f64, theta| {
            most.max((at(&polynomial, theta) - clock.at(theta).powi(degree as i32)).abs())
        })
    }

    #[test]
    fn time_itself_changes_nothing() {
        let substitution = Substitution::new(StepClock::new(0.0), 7);
        let polynomial: Coefficients = std::array::from_fn(|i| 1.0 / (i as f64 - 2.5));
        assert_eq!(in_theta(&substitution, polynomial), polynomial);
        assert_eq!(substitution.terms(3), 3);
        assert_eq!(substitution.clock().nodes(&[3.0, 2.0], 2.0, 4.0)[..2], [0.25, 0.0]);
    }

    #[test]
    fn powers_of_the_clock_are_polynomials_to_what_steps_need() {
        for order in 1..=HIGHEST_ORDER {
            let worst = |run| (0..=order + 1).map(|degree| error(run, order, degree)).fold(0.0, f64::max);
            let part = 0.4_f64.powi(order as i32 - 1);
            assert!(worst(1.0) < 1e-3 * part, "a step that doubles the time: {:.1e}", worst(1.0));
            assert!(worst(0.1) < 5e-6 * part, "a step of a tight tolerance: {:.1e}", worst(0.1));
        }
    }

    #[test]
    fn both_ends_are_exact() {
        let substitution = Substitution::new(StepClock::new(0.7), 8);
        let polynomial: Coefficients = std::array::from_fn(|i| if i < 5 { 0.5 - i as f64 } else { 0.0 });
        let taken = in_theta(&substitution, polynomial);
        assert!((at(&taken, 0.0) - at(&polynomial, 0.0)).abs() < 1e-10);
        assert!((at(&taken, 1.0) - at(&polynomial, 1.0)).abs() < 1e-10);
    }
}
