//! `[flow]`: how the curve may move.

use schemars::JsonSchema;
use serde::Serialize;

use super::choice::names;
use super::error::Bound;
use super::formula::Formula;
use super::gauge::Gauge;
use super::keywords::{Entries, Within};
use super::section::Section;
use super::switch::{MAX_SWITCHES, Switch};
use crate::flow::MetricRole;

/// Table `[flow]`; may be left out.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(default)]
pub struct Flow {
    /// The normal mobility 𝓑.
    pub normal_mobility: NormalMobility,
    /// The rule for the tangential velocity.
    pub gauge: Gauge,
    /// The metric of the graded gauge, and the first one of the co-moving gauge, an expression of `s` in `[0, 1)` up to a
    /// factor: nodes crowd where it is small. Without one the nodes of the graded gauge follow the solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = Within(Bound::Positive))]
    pub grading: Option<Formula>,
    /// Whether the run stops once the curve crosses itself more often than at the start, in the last state before that; crossings
    /// are legal unless this is set.
    pub stop_on_contact: bool,
    /// Changes of the gauge on the way, in the order of their times.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(transform = Entries(0, MAX_SWITCHES))]
    pub switch: Vec<Switch>,
}

names! {
    /// The normal mobility 𝓑.
    pub enum NormalMobility {
        /// 𝓑 = Id: the L² gradient flow. The default.
        Identity = "identity",
        /// 𝓑 = 𝓘 = Id − κH⁻¹κ with H = `−Δ_s` + κ²: every piece of the curve keeps its length.
        Incompressible = "incompressible",
        /// 𝓑 = Id − ⟨·⟩, the mean over the curve: the enclosed area is kept.
        AreaPreserving = "area-preserving",
        /// 𝓘 less its part that changes the area: both are kept.
        IncompressibleAreaPreserving = "incompressible-area-preserving",
        /// 𝓑 = `−Δ_s`: the H⁻¹ gradient flow; the enclosed area is kept.
        SurfaceDiffusion = "surface-diffusion",
    }
}

impl Default for Flow {
    fn default() -> Self {
        Self {
            normal_mobility: NormalMobility::Identity,
            gauge: Gauge::default(),
            grading: None,
            stop_on_contact: false,
            switch: Vec::new(),
        }
    }
}

impl Flow {
    /// Whether the nodes follow the solution: graded, and no grading is given.
    #[must_use]
    pub fn follows_solution(&self) -> bool {
        self.gauge.metric() == MetricRole::Graded && self.grading.is_none()
    }

    /// `end` is the end time, if that is known.
    pub(super) fn read(mut section: Section<'_>, end: Option<f64>) -> Self {
        let default = Self::default();
        let normal_mobility = section.get("normal_mobility").and_then(|entry| entry.choice());
        let (gauge, grading) = Gauge::read(&mut section);
        let stop_on_contact = section.get("stop_on_contact").and_then(|entry| entry.boolean());
        let switch = Switch::read_all(section.get("switch"), end);
        section.finish();
        Self {
            normal_mobility: normal_mobility.unwrap_or(default.normal_mobility),
            gauge: gauge.unwrap_or(default.gauge),
            grading,
            stop_on_contact: stop_on_contact.unwrap_or(default.stop_on_contact),
            switch,
        }
    }
}
