//! What makes the result of a run doubtful although it came to its end.

use std::fmt::{self, Display, Formatter};

use super::constant_energy::energy_scale;
use super::record::Record;
use super::scene::{Nodes, Scene};
use super::simulation::ENERGY_TOLERANCE_SHARE;
use crate::integrator::ENERGY_ROUNDING;

/// Multiple of the tolerance, relative to the energy, beyond which the balance of energy and dissipation is out: steps that are each
/// within their bounds have lost it together. On the shipped scenes it is below two.
const OUT_OF_BALANCE: f64 = 3.0;

/// A reason to doubt a result, with its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Doubt<'a> {
    /// The nodes, which the program may have chosen, did not resolve most of the steps.
    Unresolved { unresolved: u64, steps: u64, chosen: bool },
    /// The energy lost and the dissipation are apart by this part of the energy, of a run with these terms from outside its scene.
    OutOfBalance { part: f64, tolerance: f64, own_terms: &'a [String] },
    /// A constant of the motion in the energy has a rounding of this part of what the flow can change.
    Drowned { constant: f64, part: f64, tolerance: f64 },
}

impl Doubt<'_> {
    /// What helps. A gradient that is wrong is out of balance at any tolerance, and takes the more steps the smaller it is.
    pub(super) fn remedy(self) -> &'static str {
        match self {
            Self::Unresolved { chosen: false, .. } => "more accuracy.nodes, or accuracy.nodes = \"auto\"",
            Self::Unresolved { chosen: true, .. } => {
                "smoother initial data, or an energy with a cost of slopes"
            }
            Self::Drowned { .. } => "an energy without that constant, which moves nothing",
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
            Self::Unresolved { unresolved, steps, .. } => write!(
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
            Self::Drowned { constant, part, tolerance } => write!(
                f,
                "{constant:.6e} of the energy is a constant of the motion, whose rounding is {part:.1e} of what the flow can change: more \
                 than the hundredth of accuracy.tolerance = {tolerance:e} by which steps and rest are judged"
            )?,
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
    // The scene of a file of another version may not be readable here.
    let scene = Scene::parse(&record.resolved_scene, "the scene of the result").ok();
    [unresolved(record, scene.as_ref())].into_iter().chain(of_energy(record, scene.as_ref())).flatten()
}

/// Of a run most of which its nodes did not resolve.
fn unresolved(record: &Record, scene: Option<&Scene>) -> Option<Doubt<'static>> {
    let (unresolved, steps) = (record.counters.unresolved_steps, record.counters.steps);
    let chosen = scene.is_some_and(|scene| scene.accuracy.nodes == Nodes::Auto);
    (2 * unresolved > steps).then_some(Doubt::Unresolved { unresolved, steps, chosen })
}

/// Of a run that has not lost the energy that it dissipated, or whose energy does not tell.
fn of_energy<'a>(record: &'a Record, scene: Option<&Scene>) -> [Option<Doubt<'a>>; 2] {
    let (Some(first), Some(last), Some(scene)) = (record.frames.first(), record.frames.last(), scene) else {
        return [None; 2];
    };
    let tolerance = scene.accuracy.tolerance;
    let scale = energy_scale(scene, record);
    let largest = scale.of(first.energy).max(scale.of(last.energy));
    let part = (last.energy_balance - last.remap_error).abs() / largest;
    let rounding = ENERGY_ROUNDING * last.energy.abs() / largest;
    // Of an energy that the flow cannot change nothing is hidden.
    let is_drowned = largest > 0.0 && rounding > ENERGY_ROUNDING.max(ENERGY_TOLERANCE_SHARE * tolerance);
    let out_of_balance = Doubt::OutOfBalance { part, tolerance, own_terms: &record.own_terms };
    let drowned = Doubt::Drowned { constant: scale.constant(), part: rounding, tolerance };
    [(part > OUT_OF_BALANCE * tolerance + rounding).then_some(out_of_balance), is_drowned.then_some(drowned)]
}
