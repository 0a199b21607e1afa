//! The start of the method, by the first two derivatives of the state. See `THEORY.md`, eq. (I13).

use super::ExponentialMemory;
use crate::integrator::error_norm::ErrorNorm;
use crate::integrator::linear_part::LinearPart;
use crate::integrator::memory::Memory;
use crate::integrator::newton::Factorisation;
use crate::integrator::pace::{LEAST_RATE, Pace};
use crate::integrator::{Counters, Integrals, Problem};

/// Values of N that the first prediction goes through.
const ORDER: usize = 2;
/// Part of the first step by which the value before the start lies apart: short enough for its series, long enough for a difference.
const APART: f64 = 0.1;
/// Part of the tolerance's cube root by which the first step moves the state.
const FIRST_PART: f64 = 0.2;

/// What the method knows at the start of a trajectory: the state `y`, with Λ = `part` and the linearisation of `problem` at it, and a
/// state before, both with their rates. The prediction through them is N with its slope.
pub fn start(
    problem: &mut dyn Problem,
    (y, part): (&[f64], LinearPart),
    integrals: Integrals,
    tolerance: f64,
    counters: &mut Counters,
) -> Memory {
    let [mut rate, mut slope] = [vec![0.0; y.len()], vec![0.0; y.len()]];
    problem.rate(y, &mut rate);
    problem.jacobian_product(&rate, &mut slope);
    counters.right_hand_sides += 2; // the product takes as much
    let mut norm = ErrorNorm::new(problem);
    norm.rescale(problem, y);
    let step = first_step(tolerance, norm.norm(&rate), norm.norm(&slope));
    let ago = APART * step;
    let state_before =
        y.iter().zip(&rate).zip(&slope).map(|((y, rate), slope)| y - ago * (rate - 0.5 * ago * slope));
    let rate_before = rate.iter().zip(&slope).map(|(rate, slope)| rate - ago * slope).collect();
    let time = integrals.time();
    Memory {
        points: vec![(time, y.to_vec()), (time - ago, state_before.collect())],
        integrals,
        factorisation: Factorisation::default(),
        pace: Pace { order: ORDER, ..Pace::starting(step) },
        exponential: Some(ExponentialMemory::new(vec![rate, rate_before], part)),
    }
}

/// A first step that moves the state by a small part of the tolerance's cube root, by its rate and by the slope of that: the error of
/// order 2 is O(h³). At rest the rate is rounding, and the slope tells how much of it.
fn first_step(tolerance: f64, rate: f64, slope: f64) -> f64 {
    let part = FIRST_PART * tolerance.cbrt();
    part / rate.max((part * slope).sqrt()).max(LEAST_RATE)
}
