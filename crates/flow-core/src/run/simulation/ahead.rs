//! Where the flow goes from a state.

use crate::geometry::vectors::{add_scaled, dot};
use crate::integrator::Problem;
use crate::run::membrane::Membrane;

/// Part of the state by which it moves.
const LITTLE: f64 = 1e-6;

/// The spectral `state`, a little later; the state itself where the flow is at rest. No number where it has no rate.
#[cold]
pub(super) fn ahead(membrane: &mut Membrane, state: &[f64]) -> Vec<f64> {
    let (mut ahead, mut rate) = (state.to_vec(), vec![0.0; state.len()]);
    membrane.rate(state, &mut rate);
    let [size, speed] = [state, &rate].map(|values| dot(values, values).sqrt());
    add_scaled(&mut ahead, LITTLE * size / speed.max(f64::MIN_POSITIVE), &rate);
    ahead
}
