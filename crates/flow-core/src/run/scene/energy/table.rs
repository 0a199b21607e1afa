//! The list of energy terms.

use serde::Serialize;

use super::{Agents, Bending, Length, Local, Regularization};
use crate::run::scene::section::Section;

/// Terms of later versions.
const PLANNED: [&str; 4] = ["area", "membrane", "packing", "adhesion"];

/// Energies named by the scene; an absent table is an absent term.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Energy {
    /// Table `[energy.bending]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bending: Option<Bending>,
    /// Table `[energy.regularization]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regularization: Option<Regularization>,
    /// Table `[energy.length]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<Length>,
    /// Table `[energy.agents]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agents: Option<Agents>,
    /// Table `[energy.local]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub local: Option<Local>,
}

impl Energy {
    /// Reads `[energy]`; `densities` are the names that terms may refer to. `None` if it has no term at all.
    pub(in crate::run::scene) fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let energy = Self {
            bending: section.section("bending").and_then(Bending::read),
            regularization: section.section("regularization").and_then(Regularization::read),
            length: section.section("length").and_then(Length::read),
            agents: section.section("agents").and_then(|table| Agents::read(table, densities)),
            local: section.section("local").and_then(|table| Local::read(table, densities)),
        };
        for key in PLANNED {
            section.planned(key);
        }
        let empty = section.is_empty();
        section.finish();
        (!empty).then_some(energy)
    }
}
