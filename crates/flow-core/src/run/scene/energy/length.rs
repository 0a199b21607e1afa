//! `[energy.length]`: tension `σ|Γ|`, or penalty `(β/2)(|Γ| − L*)²`.

use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::error::{Bound, Fault};
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the length energy.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Length {
    /// `σ|Γ|`.
    Tension {
        /// Line tension σ of either sign, in energy / length.
        tension: f64,
    },
    /// `(β/2)(|Γ| − L*)²`.
    Penalty {
        /// Strength β ≥ 0, in energy / length².
        #[schemars(transform = Within(Bound::AtLeast(0.0)))]
        penalty: f64,
        /// The length L* that costs nothing.
        #[serde(flatten)]
        target: LengthTarget,
    },
}

/// The length that a penalty aims at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub enum LengthTarget {
    /// In the unit of length.
    #[serde(rename = "target")]
    Absolute(
        /// L* itself, > 0.
        #[schemars(transform = Within(Bound::Positive))]
        f64,
    ),
    /// Relative to the curve at the start.
    #[serde(rename = "target_ratio")]
    Ratio(
        /// L* over the initial length |Γ₀|, > 0.
        #[schemars(transform = Within(Bound::Positive))]
        f64,
    ),
}

impl LengthTarget {
    /// L* itself, if the curve has the length `initial` at the start.
    pub(in crate::run) fn length(self, initial: f64) -> f64 {
        match self {
            Self::Absolute(target) => target,
            Self::Ratio(ratio) => ratio * initial,
        }
    }
}

impl EnergyTable for Length {
    fn read(mut section: Section<'_>, _: &[String]) -> Option<Self> {
        if !section.has("tension") {
            return Self::read_penalty(section);
        }
        let tension = section.get("tension");
        let tension = tension.and_then(|entry| entry.number(Bound::Finite, "try tension = 1.0"));
        for key in ["penalty", "target", "target_ratio"] {
            if section.get(key).is_some() {
                let remedy = "keep `tension` alone, or `penalty` with its target";
                section.fault(key, Fault::Conflict { with: "energy.length.tension", remedy });
            }
        }
        section.finish();
        Some(Self::Tension { tension: tension? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        Ok(Box::new(match self {
            Self::Tension { tension } => energies::Length::Tension(*tension),
            Self::Penalty { penalty, target } => {
                energies::Length::Penalty { penalty: *penalty, target: target.length(start.length) }
            }
        }))
    }
}

impl Length {
    fn read_penalty(mut section: Section<'_>) -> Option<Self> {
        let penalty = section.required("penalty", "penalty = 3.0 with target_ratio = 1.0, or tension = 1.0");
        let penalty = penalty.and_then(|entry| entry.number(Bound::AtLeast(0.0), "try penalty = 3.0"));
        let target = if section.has("target") {
            let absolute = section.get("target");
            if section.get("target_ratio").is_some() {
                let remedy = "keep one of the two";
                section.fault("target_ratio", Fault::Conflict { with: "energy.length.target", remedy });
            }
            let remedy = "try target_ratio = 1.0 instead, the initial length";
            absolute.and_then(|entry| entry.number(Bound::Positive, remedy)).map(LengthTarget::Absolute)
        } else {
            let ratio =
                section.required("target_ratio", "target_ratio = 1.0 (the initial length), or target = 6.3");
            section.get("target");
            let remedy = "try target_ratio = 1.0, the initial length";
            ratio.and_then(|entry| entry.number(Bound::Positive, remedy)).map(LengthTarget::Ratio)
        };
        section.get("tension");
        section.finish();
        Some(Self::Penalty { penalty: penalty?, target: target? })
    }
}
