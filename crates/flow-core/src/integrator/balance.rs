//! The balance of energy and dissipation: how it limits the steps, and whether it closes at all as they shrink.

use super::pace::on_scale;
use super::{Finish, Problem};

/// Part of the energy by which rounding may raise it in one step.
pub const ENERGY_ROUNDING: f64 = 1e-13;
/// Multiple of the energy tolerance by which the balance of one step may be off; such steps are few.
pub const IMBALANCE: f64 = 25.0;
/// Part of that at which the next step is to be, where it would grow beyond that, and the part that does not count.
const IN_BALANCE: f64 = 0.3;
pub const BALANCED: f64 = 0.1;
/// Power of the step by which the balance of one step falls, about: that of the polynomials through the dissipation.
const BALANCE_POWER: f64 = 6.0;

/// Growth of a step out of balance by `imbalance` that brings the next one to what is worth no growth.
pub fn growth_in_balance(imbalance: f64) -> f64 {
    if imbalance < BALANCED {
        return f64::INFINITY;
    }
    on_scale((IN_BALANCE / imbalance).powf(1.0 / BALANCE_POWER))
}

/// Sizes of the differences that are looked at: powers of the first from the second to the third, times the size of the step.
const RATIO: f64 = 8.0;
const SMALLEST: i32 = -4;
const LARGEST: i32 = 12;
/// Part of the dissipation by which an exact derivative may be off in a difference.
const CLOSED: f64 = 1e-5;
/// Part of what is found that rounding, or one difference against the next, may be.
const CERTAIN: f64 = 0.01;

/// What the energy loses along f at `state`, as a part of the dissipation there, if that is not 1 as the step shrinks: none if it is,
/// or if rounding and curvature leave no difference that tells.
///
/// The error of the central difference falls with the square of its size, by 64 from one to the next: where two of them agree on what
/// is missing, it is the derivative that is wrong. `problem` has finished another state last when this returns.
pub fn share_lost(problem: &mut dyn Problem, time: f64, state: &[f64], size: f64) -> Option<f64> {
    let mut rate = vec![0.0; state.len()];
    problem.rate(state, &mut rate);
    let mut moved = state.to_vec();
    let finish = problem.finish(time, &mut moved);
    let Finish::Good { energy, .. } = finish else { return None };
    let dissipation = finish.dissipation();
    let rounding = ENERGY_ROUNDING * energy.abs() + problem.energy_rounding(&moved);
    let mut energy_after = |step: f64| {
        moved.iter_mut().zip(state).zip(&rate).for_each(|((moved, y), f)| *moved = y + step * f);
        match problem.finish(time, &mut moved) {
            Finish::Good { energy, .. } => energy,
            Finish::NotFinite => f64::NAN,
        }
    };
    let mut before: Option<f64> = None;
    let mut found = None;
    for power in SMALLEST..=LARGEST {
        let step = size * RATIO.powi(power);
        let missing = 1.0 - (energy_after(-step) - energy_after(step)) / (2.0 * step * dissipation);
        if !missing.is_finite() {
            break;
        }
        if rounding / (step * dissipation) > CERTAIN * missing.abs().max(CLOSED) {
            continue;
        }
        if missing.abs() < CLOSED {
            break;
        }
        if before.is_some_and(|before| (missing - before).abs() < CERTAIN * missing.abs()) {
            found = Some(1.0 - missing);
            break;
        }
        before = Some(missing);
    }
    found
}
