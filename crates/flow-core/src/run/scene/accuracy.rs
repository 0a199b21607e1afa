//! `[accuracy]`: how exact the answer is to be, and by which methods.

use schemars::{JsonSchema, json_schema};
use serde::{Serialize, Serializer};

use super::choice::names;
use super::count::serialize_count;
use super::entry::Entry;
use super::error::{Bound, Fault};
use super::flow::NormalMobility;
use super::keywords::{Within, inline_schema};
use super::section::Section;
use crate::operators::{DerivativeFamily, Helmholtz};

/// The tightest tolerance is at the rounding of double precision.
pub(in crate::run) const TIGHTEST: f64 = 1e-11;
pub(in crate::run) const LOOSEST: f64 = 1e-1;
pub(in crate::run) const FEWEST_NODES: usize = 8;
pub(in crate::run) const MOST_NODES: usize = 65_536;
const TOLERANCE: Bound = Bound::Between(TIGHTEST, LOOSEST);

/// Table `[accuracy]`; may be left out.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(default)]
pub struct Accuracy {
    /// The relative error asked for, in time and in space together: in [1e-11, 1e-1], 1e-5 unless given.
    #[schemars(transform = Within(TOLERANCE))]
    pub tolerance: f64,
    /// Number of nodes on the curve.
    pub nodes: Nodes,
    /// Discrete derivative along the curve.
    pub derivative: Derivative,
    /// Solver of the linear systems of the implicit steps; naming one makes all steps implicit.
    pub linear_solver: LinearSolver,
}

/// Number of nodes: `"auto"` (the default), or 8 to 65536.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Nodes {
    /// As many as the tolerance needs.
    #[default]
    Auto,
    /// This many.
    Count(usize),
}

impl std::fmt::Display for Nodes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => f.write_str("as many nodes as it needs"),
            Self::Count(count) => write!(f, "{count} nodes"),
        }
    }
}

names! {
    /// The discrete derivative; all are exactly skew.
    pub enum Derivative {
        /// `fourier`, but `central-8` on graded nodes that follow the solution: its linear systems are the easier ones there.
        /// The default.
        Auto = "auto",
        /// Trigonometric interpolation.
        Fourier = "fourier",
        /// Central differences of order 2.
        Central2 = "central-2",
        /// Central differences of order 4.
        Central4 = "central-4",
        /// Central differences of order 6.
        Central6 = "central-6",
        /// Central differences of order 8.
        Central8 = "central-8",
    }
}

names! {
    /// The solver of the linear systems of the implicit steps.
    pub enum LinearSolver {
        /// The program chooses. The default.
        Auto = "auto",
        /// Krylov iteration, preconditioned by constant coefficients in Fourier space.
        Fourier = "fourier",
        /// Krylov iteration, preconditioned by a banded factorisation.
        Banded = "banded",
        /// Factorisation of the full matrix.
        Dense = "dense",
    }
}

impl Derivative {
    /// The family that it names; none if the program chooses.
    #[must_use]
    pub fn family(self) -> Option<DerivativeFamily> {
        match self {
            Self::Auto => None,
            Self::Fourier => Some(DerivativeFamily::Fourier),
            Self::Central2 => Some(DerivativeFamily::Central2),
            Self::Central4 => Some(DerivativeFamily::Central4),
            Self::Central6 => Some(DerivativeFamily::Central6),
            Self::Central8 => Some(DerivativeFamily::Central8),
        }
    }
}

impl Default for Accuracy {
    fn default() -> Self {
        Self {
            tolerance: 1e-5,
            nodes: Nodes::Auto,
            derivative: Derivative::Auto,
            linear_solver: LinearSolver::Auto,
        }
    }
}

impl Accuracy {
    /// Reads `[accuracy]` of a scene with the normal mobility `mobility`.
    pub(super) fn read(mut section: Section<'_>, mobility: NormalMobility) -> Self {
        let default = Self::default();
        let tolerance = section.get("tolerance");
        let tolerance = tolerance.and_then(|entry| entry.number(TOLERANCE, "try 1e-5, the default"));
        let nodes = section.get("nodes").and_then(|entry| read_nodes(&entry));
        let derivative = section.get("derivative").and_then(|entry| entry.choice());
        let linear_solver = section.get("linear_solver").and_then(|entry| entry.choice());
        check_mobility(&section, mobility, nodes);
        section.finish();
        Self {
            tolerance: tolerance.unwrap_or(default.tolerance),
            nodes: nodes.unwrap_or(default.nodes),
            derivative: derivative.unwrap_or(default.derivative),
            linear_solver: linear_solver.unwrap_or(default.linear_solver),
        }
    }
}

/// What the methods cannot do with some mobilities.
fn check_mobility(section: &Section<'_>, mobility: NormalMobility, nodes: Option<Nodes>) {
    let band =
        matches!(mobility, NormalMobility::Incompressible | NormalMobility::IncompressibleAreaPreserving);
    if let Some(Nodes::Count(count)) = nodes.filter(|_| band)
        && count < Helmholtz::FEWEST_NODES
    {
        let bound = Bound::Between(Helmholtz::FEWEST_NODES as f64, MOST_NODES as f64);
        let remedy = "an incompressible curve needs more; try 128, or \"auto\"";
        let (value, written) = (count as f64, count.to_string());
        section.fault("nodes", Fault::OutOfRange { value, written, bound, remedy });
    }
}

fn read_nodes(entry: &Entry<'_>) -> Option<Nodes> {
    if entry.is("auto") {
        return Some(Nodes::Auto);
    }
    let remedy = "try 256, or \"auto\"";
    let bound = Bound::Between(FEWEST_NODES as f64, MOST_NODES as f64);
    entry.integer_or("an integer or \"auto\"", bound, remedy).map(|count| Nodes::Count(count as usize))
}

inline_schema!(
    Nodes,
    json_schema!({
        "anyOf": [
            { "type": "string", "const": "auto" },
            { "type": "integer", "minimum": FEWEST_NODES, "maximum": MOST_NODES },
        ],
    })
);

impl Serialize for Nodes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Auto => serializer.serialize_str("auto"),
            Self::Count(ref count) => serialize_count(count, serializer),
        }
    }
}
