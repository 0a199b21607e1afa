//! What makes the result of a run doubtful although it came to its end.

use std::fmt::{self, Display, Formatter};

use super::record::Record;
use super::scene::Scene;

/// Multiple of the tolerance, relative to the energy, beyond which the balance of energy and dissipation is out: steps that are each
/// within their bounds have lost it together. On the shipped scenes it is below two.
const OUT_OF_BALANCE: f64 = 3.0;

/// A reason to doubt a result, with its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Doubt<'a> {
    /// The nodes did not resolve most of the steps.
    Unresolved { unresolved: u64, steps: u64 },
    /// The energy lost and the dissipation are apart by this part of the energy, of a run with these terms from outside its scene.
    OutOfBalance { part: f64, tolerance: f64, own_terms: &'a [String] },
}

impl Doubt<'_> {
    /// What helps. A gradient that is wrong is out of balance at any tolerance, and takes the more steps the smaller it is.
    pub(super) fn remedy(self) -> &'static str {
        match self {
            Self::Unresolved { .. } => "more accuracy.nodes, or accuracy.nodes = \"auto\"",
            Self::OutOfBalance { own_terms: [], .. } => "a smaller accuracy.tolerance",
            Self::OutOfBalance { .. } => {
                "a look at what GradientFlow::check_derivatives says of them, and a smaller accuracy.tolerance only if their \
                 gradients are right"
            }
        }
    }
}

impl Display for Doubt<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unresolved { unresolved, steps } => write!(
                f,
                "{unresolved} of the {steps} steps were not resolved by their nodes, and the result depends on these"
            )?,
            Self::OutOfBalance { part, tolerance, own_terms } => {
                write!(
                    f,
                    "the energy lost and the dissipation are apart by {part:.1e} of the energy, more than accuracy.tolerance = \
                     {tolerance:e} promises"
                )?;
                if !own_terms.is_empty() {
                    write!(f, ", perhaps by terms from outside the scene (`{}`)", own_terms.join("`, `"))?;
                }
            }
        }
        write!(f, ": take {}", self.remedy())
    }
}

/// One sentence on each thing that makes the result of `record` doubtful, with what helps; none if there is nothing.
#[must_use]
pub fn warnings(record: &Record) -> Vec<String> {
    doubts(record).map(|doubt| doubt.to_string()).collect()
}

/// What makes the result of `record` doubtful.
pub(super) fn doubts(record: &Record) -> impl Iterator<Item = Doubt<'_>> {
    [unresolved(record), out_of_balance(record)].into_iter().flatten()
}

/// Of a run most of which its nodes did not resolve.
fn unresolved(record: &Record) -> Option<Doubt<'_>> {
    let (unresolved, steps) = (record.counters.unresolved_steps, record.counters.steps);
    (2 * unresolved > steps).then_some(Doubt::Unresolved { unresolved, steps })
}

/// Of a run that has not lost the energy that it dissipated.
fn out_of_balance(record: &Record) -> Option<Doubt<'_>> {
    let (first, last) = (record.frames.first()?, record.frames.last()?);
    // The scene of a file of another version may not be readable here.
    let scene = Scene::parse(&record.resolved_scene, "the scene of the result").ok()?;
    let tolerance = scene.accuracy.tolerance;
    let scale = first.energy.abs().max(last.energy.abs());
    let part = (last.energy_balance - last.remap_error).abs() / scale;
    let own_terms = &record.own_terms;
    (part > OUT_OF_BALANCE * tolerance).then_some(Doubt::OutOfBalance { part, tolerance, own_terms })
}
