//! `[[density]]`: densities carried by the curve, in the order of the components.

use schemars::{JsonSchema, Schema};
use serde::Serialize;

use super::choice::names;
use super::entry::Entry;
use super::error::{Bound, Fault, Problem};
use super::formula::Formula;
use super::keywords::Within;
use super::profile::Profile;
use super::section::Section;
use crate::expression::ExpressionError;

/// Names that mean something in expressions; a density called so could not be written there.
const RESERVED: [&str; 20] = [
    "s",
    "phi",
    "q",
    "kappa",
    "kappa_sigma",
    "rho",
    "pi",
    "e",
    "exp",
    "ln",
    "log",
    "sqrt",
    "sin",
    "cos",
    "tan",
    "sinh",
    "cosh",
    "tanh",
    "abs",
    "sigma",
];
const MAX_NAME: usize = 64;
/// With the curvature they make the 8 fields whose second derivatives the energies have room for.
pub(super) const MAX_DENSITIES: usize = 7;

/// One density ρ, per unit arc length.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Density {
    /// Its name, an identifier: used in expressions, in the output file and in Python.
    #[schemars(transform = identifier)]
    pub name: String,
    /// Initial value: an expression of `s` in `[0, 1)`, the fraction of arc length from the first point; or a list of numbers, one for
    /// each point of a curve through points, on other curves at equal distances.
    pub initial: Profile,
    /// How it moves along the curve.
    pub mobility: DensityMobility,
    /// Weight w > 0 of the diffusion, an expression of `s`; 1 unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = Within(Bound::Positive))]
    pub weight: Option<Formula>,
}

names! {
    /// The density mobility 𝓖.
    pub enum DensityMobility {
        /// `𝓖 = −Δ_s`, or −∇_s(w∇_s·) with a weight w(s): the mass is conserved.
        Diffusion = "diffusion",
        /// 𝓖 = Id, the Allen–Cahn flow: the mass is not conserved.
        Exchange = "exchange",
        /// 𝓖 = 0: every piece of the curve keeps its mass.
        Carried = "none",
    }
}

/// Names of the densities.
#[derive(Default)]
pub(super) struct Names {
    /// Those that are in order.
    pub known: Vec<String>,
    /// Whether there are no others, which were refused.
    pub are_all: bool,
}

impl Names {
    /// Whether `problem` may be no more than a consequence of names that were refused.
    pub(super) fn may_cause(&self, problem: &Problem) -> bool {
        let of_a_density = match &problem.fault {
            Fault::UnknownDensity { .. } | Fault::NoDensity { .. } => true,
            Fault::Expression { source, .. } => matches!(source, ExpressionError::UnknownName { .. }),
            Fault::WrongCount { .. } => problem.key.starts_with("energy.packing.matrix"),
            _ => false,
        };
        !self.are_all && of_a_density && problem.key.starts_with("energy.")
    }
}

impl Density {
    /// Reads `[[density]]` on a curve through so many `points`, if it is one; the names come second, whether or not the rest is in order.
    pub(super) fn read_all(entry: Option<Entry<'_>>, points: Option<usize>) -> (Option<Vec<Self>>, Names) {
        let Some(list) = entry else { return (Some(Vec::new()), Names { known: Vec::new(), are_all: true }) };
        let Some(entries) = list.list("a list of tables") else { return (None, Names::default()) };
        if entries.len() > MAX_DENSITIES {
            let bound = Bound::Between(0.0, MAX_DENSITIES as f64);
            let remedy = "leave some out; what several densities share can be one";
            list.fault(Fault::WrongCount { count: entries.len(), bound, remedy });
            return (None, Names::default());
        }
        let (mut known, count) = (Vec::new(), entries.len());
        let read = |entry: Entry<'_>| Self::read(entry.section()?, points, &mut known);
        let densities: Vec<Option<Self>> = entries.into_iter().map(read).collect();
        let are_all = known.len() == count;
        (densities.into_iter().collect(), Names { known, are_all })
    }

    fn read(mut section: Section<'_>, points: Option<usize>, names: &mut Vec<String>) -> Option<Self> {
        let name = section.required("name", "name = \"protein\"");
        let name = name.and_then(|entry| checked_name(&entry, names));
        let initial = section.required("initial", "initial = \"0.5 + 0.1*cos(2*pi*s)\"");
        let initial = initial.and_then(|entry| Profile::read(&entry, points));
        let mobility = section.required("mobility", "mobility = \"diffusion\"");
        let mobility: Option<DensityMobility> = mobility.and_then(|entry| entry.choice());
        let weight =
            section.get("weight").map(|entry| entry.positive_formula("s", "add a constant, for example 0.1"));
        if let Some(other) = mobility.filter(|m| weight.is_some() && *m != DensityMobility::Diffusion) {
            let remedy = "drop the weight, or use mobility = \"diffusion\"";
            section.fault("weight", Fault::OtherChoice { choice: "mobility", value: other.name(), remedy });
        }
        section.finish();
        let weight = match weight {
            Some(weight) => Some(weight?),
            None => None,
        };
        Some(Self { name: name?, initial: initial?, mobility: mobility?, weight })
    }
}

/// A name that is in order; one that was taken already counts among `names`, so that it is one problem and not several.
fn checked_name(entry: &Entry<'_>, names: &mut Vec<String>) -> Option<String> {
    let value = entry.text()?.to_owned();
    let fault = if RESERVED.contains(&value.as_str()) {
        Fault::ReservedName { value }
    } else if !is_identifier(&value) {
        Fault::NotAnIdentifier { value }
    } else if let Some(first) = names.iter().position(|name| *name == value) {
        names.push(value.clone());
        Fault::DuplicateDensity { value, first }
    } else {
        names.push(value.clone());
        return Some(value);
    };
    entry.fault(fault);
    None
}

/// What [`checked_name`] asks for, but that names differ.
fn identifier(schema: &mut Schema) {
    schema.insert("pattern".to_owned(), "^[A-Za-z][A-Za-z0-9_]*$".into());
    schema.insert("maxLength".to_owned(), MAX_NAME.into());
    let not = serde_json::json!({ "anyOf": [{ "enum": RESERVED }, { "pattern": "_sigma$" }] });
    schema.insert("not".to_owned(), not);
}

/// `name_sigma` is the derivative of `name`, so no density may be called so.
fn is_identifier(name: &str) -> bool {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(word)
        && name.len() <= MAX_NAME
        && !name.ends_with("_sigma")
}
