//! `[flow]`: how the curve may move.

use serde::Serialize;

use super::choice::names;
use super::section::Section;

/// Table `[flow]`; may be left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Flow {
    /// The normal mobility 𝓑.
    pub normal_mobility: NormalMobility,
    /// The rule for the tangential velocity.
    pub gauge: Gauge,
    /// Whether the run stops once the curve crosses itself more often than at the start; crossings are legal unless
    /// this is set.
    pub stop_on_contact: bool,
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

names! {
    /// The gauge: which tangential velocity goes with a normal one.
    pub enum Gauge {
        /// The metric g stays uniform along the curve. The default.
        ScaledArcLength = "scaled-arc-length",
    }
}

impl Default for Flow {
    fn default() -> Self {
        Self {
            normal_mobility: NormalMobility::Identity,
            gauge: Gauge::ScaledArcLength,
            stop_on_contact: false,
        }
    }
}

impl Flow {
    pub(super) fn read(mut section: Section<'_>) -> Self {
        let default = Self::default();
        let normal_mobility = section.get("normal_mobility").and_then(|entry| entry.choice(&[]));
        let gauge = section.get("gauge").and_then(|entry| entry.choice(&["graded", "co-moving"]));
        let stop_on_contact = section.get("stop_on_contact").and_then(|entry| entry.boolean());
        section.finish();
        Self {
            normal_mobility: normal_mobility.unwrap_or(default.normal_mobility),
            gauge: gauge.unwrap_or(default.gauge),
            stop_on_contact: stop_on_contact.unwrap_or(default.stop_on_contact),
        }
    }
}
