//! The list of energy terms.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Adhesion, Agents, Area, Bending, Length, Local, Membrane, Packing, Regularization};
use crate::run::scene::section::Section;

/// Energies named by the scene; an absent table is an absent term.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[schemars(extend("minProperties" = 1))]
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
    /// Table `[energy.area]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<Area>,
    /// Table `[energy.adhesion]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<Adhesion>,
    /// Table `[energy.agents]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agents: Option<Agents>,
    /// Table `[energy.membrane]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub membrane: Option<Membrane>,
    /// Table `[energy.packing]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub packing: Option<Packing>,
    /// Table `[energy.local]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub local: Option<Local>,
}

impl Energy {
    /// Reads `[energy]`; `densities` are the names that terms may refer to. `None` if it has no term at all.
    pub(in crate::run::scene) fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let energy = Self {
            bending: section.section("bending").and_then(|table| Bending::read(table, densities)),
            regularization: section.section("regularization").and_then(Regularization::read),
            length: section.section("length").and_then(Length::read),
            area: section.section("area").and_then(Area::read),
            adhesion: section.section("adhesion").and_then(Adhesion::read),
            agents: section.section("agents").and_then(|table| Agents::read(table, densities)),
            membrane: section.section("membrane").and_then(|table| Membrane::read(table, densities)),
            packing: section.section("packing").and_then(|table| Packing::read(table, densities)),
            local: section.section("local").and_then(|table| Local::read(table, densities)),
        };
        let empty = section.is_empty();
        section.finish();
        (!empty).then_some(energy)
    }
}
