//! What makes the result of a run doubtful although it came to its end.

use super::record::Record;
use super::scene::Scene;

/// Multiple of the tolerance, relative to the energy, beyond which the balance of energy and dissipation is out: steps that are each
/// within their bounds have lost it together. On the shipped scenes it is below two.
const OUT_OF_BALANCE: f64 = 3.0;

/// One sentence on each thing that makes the result of `record` doubtful, with what helps; none if there is nothing.
#[must_use]
pub fn warnings(record: &Record) -> Vec<String> {
    [unresolved(record), out_of_balance(record)].into_iter().flatten().collect()
}

/// Of a run most of which its nodes did not resolve.
fn unresolved(record: &Record) -> Option<String> {
    let (unresolved, steps) = (record.counters.unresolved_steps, record.counters.steps);
    (2 * unresolved > steps).then(|| {
        format!(
            "{unresolved} of the {steps} steps were not resolved by their nodes, and the result depends on these: take more of them, \
             or accuracy.nodes = \"auto\""
        )
    })
}

/// Of a run that has not lost the energy that it dissipated.
fn out_of_balance(record: &Record) -> Option<String> {
    let (first, last) = (record.frames.first()?, record.frames.last()?);
    // The scene of a file of another version may not be readable here.
    let scene = Scene::parse(&record.resolved_scene, "the scene of the result").ok()?;
    let tolerance = scene.accuracy.tolerance;
    let scale = first.energy.abs().max(last.energy.abs());
    let part = (last.energy_balance - last.remap_error).abs() / scale;
    (part > OUT_OF_BALANCE * tolerance).then(|| {
        format!(
            "the energy lost and the dissipation are apart by {part:.1e} of the energy, more than accuracy.tolerance = {tolerance:e} \
             promises: take a smaller tolerance"
        )
    })
}
