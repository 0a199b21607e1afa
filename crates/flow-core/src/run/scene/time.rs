//! `[time]`: how long to run.

use schemars::JsonSchema;
use serde::Serialize;

use super::count::serialize_given_count;
use super::error::Bound;
use super::keywords::Within;
use super::section::Section;

/// Integers beyond this are not exact as floats; no run takes as many steps.
const STEPS: Bound = Bound::Between(1.0, 1e15);
const EQUILIBRIUM_TOLERANCE: Bound = Bound::PositiveUpTo(1e-2);

/// Table `[time]`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Time {
    /// Simulated time at which the run ends at the latest, > 0.
    #[schemars(transform = Within(Bound::Positive))]
    pub end: f64,
    /// Whether to stop before `end` once the flow is at rest: a metastable state counts if its creep, as it is, would lose less than
    /// the tolerance until `end`. True unless given.
    #[schemars(default = "stops_at_equilibrium")]
    pub stop_at_equilibrium: bool,
    /// At rest means: the energy still to be lost, judged by the dissipation, is at most this fraction of the
    /// energy. In (0, 1e-2]; a hundredth of the accuracy's tolerance unless given, a tenth with co-moving nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = Within(EQUILIBRIUM_TOLERANCE))]
    pub equilibrium_tolerance: Option<f64>,
    /// Accepted steps after which the run stops, at least 1; unlimited unless given.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_given_count")]
    #[schemars(transform = Within(STEPS))]
    pub max_steps: Option<u64>,
}

/// Unless given.
fn stops_at_equilibrium() -> bool {
    true
}

impl Time {
    pub(super) fn read(mut section: Section<'_>) -> Option<Self> {
        let end = section.required("end", "end = 1.0");
        let end = end.and_then(|entry| entry.number(Bound::Positive, "try end = 1.0"));
        let stop_at_equilibrium = section.get("stop_at_equilibrium").and_then(|entry| entry.boolean());
        let rest = section.get("equilibrium_tolerance");
        let rest = rest.and_then(|entry| {
            entry.number(EQUILIBRIUM_TOLERANCE, "try 1e-7: energy still to be lost, relative to the energy")
        });
        let max_steps = section.get("max_steps");
        let max_steps =
            max_steps.and_then(|entry| entry.integer(STEPS, "drop the key for as many steps as it takes"));
        section.finish();
        Some(Self {
            end: end?,
            stop_at_equilibrium: stop_at_equilibrium.unwrap_or_else(stops_at_equilibrium),
            equilibrium_tolerance: rest,
            max_steps: max_steps.map(i64::unsigned_abs),
        })
    }
}
