//! `[energy.adhesion]`: `∬ G(|γ(σ) − γ(σ′)|²) dσ dσ′`.

use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies::{self, CutOff};
use crate::run::scene::error::Bound;
use crate::run::scene::formula::Formula;
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the interaction of the curve with itself.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Adhesion {
    /// Kernel G, an expression of `q`, the squared distance of two points; in energy / length².
    pub kernel: Formula,
    /// Distance beyond which the kernel is taken as zero, where it should be; if absent, the distance beyond which
    /// G and G′ are below the rounding of their largest values.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = Within(Bound::Positive))]
    pub cutoff: Option<f64>,
}

impl EnergyTable for Adhesion {
    fn read(mut section: Section<'_>, _: &[String]) -> Option<Self> {
        let kernel = section.required("kernel", "kernel = \"10*(1 - q/0.25)*exp(-q/0.25)\"");
        let kernel = kernel.and_then(|entry| entry.formula(&["q"]));
        let cutoff = section.get("cutoff").map_or(Some(None), |entry| {
            let remedy = "try cutoff = 2.0, or drop the key for the distance where the kernel has decayed";
            entry.number(Bound::Positive, remedy).map(Some)
        });
        section.finish();
        Some(Self { kernel: kernel?, cutoff: cutoff? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        let cut_off = self.cutoff.map_or(CutOff::Automatic { length: start.length }, CutOff::At);
        let term = energies::Adhesion::new(self.kernel.expression(), cut_off, start.nodes);
        Ok(Box::new(term.map_err(|fault| ("energy.adhesion.kernel", fault))?))
    }

    fn cheaper(&self) -> Option<&'static str> {
        Some("a smaller energy.adhesion.cutoff, or fewer accuracy.nodes: pairs of nodes are what it costs")
    }
}
