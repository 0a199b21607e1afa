//! `[energy.area]`: pressure `−pA`, or penalty `(β/2)(A − A*)²` on the enclosed area A.

use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::error::{Bound, Fault};
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the area energy.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Area {
    /// `−pA`.
    Pressure {
        /// Pressure p inside, of either sign, in energy / area.
        pressure: f64,
    },
    /// `(β/2)(A − A*)²`.
    Penalty {
        /// Strength β ≥ 0, in energy / area².
        #[schemars(transform = Within(Bound::AtLeast(0.0)))]
        penalty: f64,
        /// The area A* that costs nothing.
        #[serde(flatten)]
        target: AreaTarget,
    },
}

/// The area that a penalty aims at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub enum AreaTarget {
    /// In the unit of area.
    #[serde(rename = "target")]
    Absolute(
        /// A* itself, signed: positive inside a counter-clockwise curve, 0 for a symmetric figure eight.
        f64,
    ),
    /// Relative to the curve at the start.
    #[serde(rename = "target_ratio")]
    Ratio(
        /// A* over the initial area, > 0.
        #[schemars(transform = Within(Bound::Positive))]
        f64,
    ),
}

impl AreaTarget {
    /// A* itself, if the curve encloses the area `initial` at the start.
    fn area(self, initial: f64) -> f64 {
        match self {
            Self::Absolute(target) => target,
            Self::Ratio(ratio) => ratio * initial,
        }
    }
}

impl EnergyTable for Area {
    fn read(mut section: Section<'_>, _: &[String]) -> Option<Self> {
        let of_penalty = ["penalty", "target", "target_ratio"];
        if !section.has("pressure") && of_penalty.iter().any(|key| section.has(key)) {
            return Self::read_penalty(section);
        }
        let pressure =
            section.required("pressure", "pressure = 1.0, or penalty = 10.0 with target_ratio = 1.0");
        let pressure = pressure.and_then(|entry| entry.number(Bound::Finite, "try pressure = 1.0"));
        for key in of_penalty {
            if section.get(key).is_some() {
                let remedy = "keep `pressure` alone, or `penalty` with its target";
                section.fault(key, Fault::Conflict { with: "energy.area.pressure", remedy });
            }
        }
        section.finish();
        Some(Self::Pressure { pressure: pressure? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        Ok(Box::new(match self {
            Self::Pressure { pressure } => energies::Area::Pressure(*pressure),
            Self::Penalty { penalty, target } => {
                energies::Area::Penalty { penalty: *penalty, target: target.area(start.area) }
            }
        }))
    }
}

impl Area {
    fn read_penalty(mut section: Section<'_>) -> Option<Self> {
        let penalty =
            section.required("penalty", "penalty = 10.0 with target_ratio = 1.0, or pressure = 1.0");
        let penalty = penalty.and_then(|entry| entry.number(Bound::AtLeast(0.0), "try penalty = 10.0"));
        let target = if section.has("target") {
            let absolute = section.get("target");
            if section.get("target_ratio").is_some() {
                let remedy = "keep one of the two";
                section.fault("target_ratio", Fault::Conflict { with: "energy.area.target", remedy });
            }
            let remedy = "try target_ratio = 1.0 instead, the initial area";
            absolute.and_then(|entry| entry.number(Bound::Finite, remedy)).map(AreaTarget::Absolute)
        } else {
            let ratio =
                section.required("target_ratio", "target_ratio = 1.0 (the initial area), or target = 3.1");
            section.get("target");
            let remedy = "try target_ratio = 1.0, the initial area, or give the area itself as target";
            ratio.and_then(|entry| entry.number(Bound::Positive, remedy)).map(AreaTarget::Ratio)
        };
        section.get("pressure");
        section.finish();
        Some(Self::Penalty { penalty: penalty?, target: target? })
    }
}
