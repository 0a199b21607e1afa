//! `[time]`: how long to run.

use serde::Serialize;

use super::error::Bound;
use super::section::Section;

/// Default of [`Time::equilibrium_ratio`].
const EQUILIBRIUM_RATIO: f64 = 1e-14;
/// Integers beyond this are not exact as floats; no run takes as many steps.
const MAX_STEPS: f64 = 1e15;

/// Table `[time]`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Time {
    /// Simulated time at which the run ends at the latest, > 0.
    pub end: f64,
    /// Whether to stop before `end` once the flow is at rest. True unless given.
    pub stop_at_equilibrium: bool,
    /// At rest means: the dissipation is at most this fraction of the largest one since the start. In (0, 1e-2],
    /// 1e-14 unless given; without effect if `stop_at_equilibrium` is false.
    pub equilibrium_ratio: f64,
    /// Accepted steps after which the run stops, at least 1; unlimited unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_steps: Option<u64>,
}

impl Time {
    pub(super) fn read(mut section: Section<'_>) -> Option<Self> {
        let end = section.required("end", "end = 1.0");
        let end = end.and_then(|entry| entry.number(Bound::Positive, "try end = 1.0"));
        let stop_at_equilibrium = section.get("stop_at_equilibrium").and_then(|entry| entry.boolean());
        let ratio = section.get("equilibrium_ratio");
        let ratio = ratio.and_then(|entry| {
            entry.number(
                Bound::PositiveUpTo(1e-2),
                "try 1e-14, the default: dissipation relative to its largest value",
            )
        });
        let max_steps = section.get("max_steps");
        let max_steps = max_steps.and_then(|entry| {
            entry.integer(Bound::Between(1.0, MAX_STEPS), "drop the key for as many steps as it takes")
        });
        section.finish();
        Some(Self {
            end: end?,
            stop_at_equilibrium: stop_at_equilibrium.unwrap_or(true),
            equilibrium_ratio: ratio.unwrap_or(EQUILIBRIUM_RATIO),
            max_steps: max_steps.map(i64::unsigned_abs),
        })
    }
}
