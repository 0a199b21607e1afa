//! `[energy.bending]`: `∫ (b/2) κ² dσ`.

use serde::Serialize;

use crate::run::scene::error::Bound;
use crate::run::scene::section::Section;

/// Parameters of the bending energy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bending {
    /// Bending rigidity b ≥ 0, in energy × length.
    pub rigidity: f64,
}

impl Bending {
    pub(super) fn read(mut section: Section<'_>) -> Option<Self> {
        let rigidity = section.required("rigidity", "rigidity = 1.0");
        let rigidity = rigidity.and_then(|entry| entry.number(Bound::AtLeast(0.0), "try rigidity = 1.0"));
        section.planned("preferred_curvature");
        section.finish();
        Some(Self { rigidity: rigidity? })
    }
}
