//! How much of a state may be left unresolved.

use crate::run::scene::Scene;

/// Part of a state, in units of the tolerance, that may be left unresolved for errors of about the tolerance.
const LEFT_OUT: f64 = 2.0;
/// With more left out, curves that are closed on their nodes are seen to gape between them.
const MOST_LEFT_OUT: f64 = 3e-4;
/// The same for fronts, but never less than the second: fronts that are hardly resolved are held by the nodes, and that error is far
/// larger than what is not resolved.
const LEFT_OUT_OF_FRONTS: f64 = 0.05;
const FRONTS_RESOLVED: f64 = 2e-5;
/// With more left out, sharp fronts do not come to rest on nodes that follow them.
const MOST_LEFT_OUT_OF_FRONTS_IN_CROWDS: f64 = 1e-4;
/// The rounding of spectra.
const LEAST_LEFT_OUT: f64 = 1e-13;
/// The part of that on nodes that follow the solution: what is not resolved lets the solution slide off its crowds, and
/// few more nodes take that away.
const LEFT_OUT_OF_CROWDS: f64 = 0.1;

/// Part of the states of `scene` that may be left unresolved, as `resolution::unresolved` measures it.
pub fn unresolved_bound(scene: &Scene) -> f64 {
    let part = LEFT_OUT * scene.accuracy.tolerance;
    let part = match (scene.flow.follows_solution(), scene.energy.front_width().is_some()) {
        (true, true) => part.min(MOST_LEFT_OUT_OF_FRONTS_IN_CROWDS) * LEFT_OUT_OF_CROWDS,
        (true, false) => part.min(MOST_LEFT_OUT) * LEFT_OUT_OF_CROWDS,
        (false, true) => {
            part.min((LEFT_OUT_OF_FRONTS * scene.accuracy.tolerance).clamp(FRONTS_RESOLVED, MOST_LEFT_OUT))
        }
        (false, false) => part.min(MOST_LEFT_OUT),
    };
    part.max(LEAST_LEFT_OUT)
}
