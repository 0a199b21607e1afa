//! `[output]`: which states to save.

use schemars::JsonSchema;
use serde::Serialize;

use super::choice::names;
use super::count::serialize_count;
use super::entry::Entry;
use super::error::{Bound, Fault};
use super::keywords::{Each, Entries, Within};
use super::section::Section;

/// More frames than this are more likely a slip than a wish.
const MAX_FRAMES: usize = 100_000;
const COUNT: Bound = Bound::Between(1.0, MAX_FRAMES as f64);

/// Table `[output]`; may be left out.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Output {
    /// When to save a state; the initial and the final one are always saved.
    #[serde(flatten)]
    pub frames: Frames,
    /// Fields to save besides those that every frame holds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub fields: Vec<OutputField>,
}

/// When to save a state.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
#[non_exhaustive]
pub enum Frames {
    /// A number of frames over the whole run.
    Spaced {
        /// How many, at least 1; 200 unless given.
        #[serde(serialize_with = "serialize_count")]
        #[schemars(default = "default_frames", transform = Within(COUNT))]
        frames: usize,
        /// How they are spread over the time.
        #[schemars(default = "default_spacing")]
        spacing: Spacing,
    },
    /// At given times.
    At {
        /// Increasing, each in [0, end].
        #[schemars(transform = Each(Bound::AtLeast(0.0)), transform = Entries(1, MAX_FRAMES))]
        times: Vec<f64>,
    },
}

names! {
    /// How frames are spread over the time.
    pub enum Spacing {
        /// At equal distances. The default.
        Linear = "linear",
        /// At equal ratios, so that early changes are seen too.
        Log = "log",
    }
}

names! {
    /// A field that frames hold on request, at the nodes.
    pub enum OutputField {
        /// The force f on the normal motion, before the mobility.
        NormalForce = "normal-force",
        /// The tangential velocity W of the gauge.
        TangentialVelocity = "tangential-velocity",
        /// ρ̄ = −H⁻¹(κV̂) with the force V̂ of all terms but the membrane's: an incompressible membrane of
        /// compressibility ε has the density 1 + ερ̄.
        ExcessDensity = "excess-density",
        /// −∇_sρ̄ in the direction of the tangent.
        MembraneFlux = "membrane-flux",
        /// Energy per length of the local terms: not of functions of the length or of the positions.
        EnergyDensity = "energy-density",
        /// The same of each local term: `energy_density_bending`, …
        EnergyDensities = "energy-densities",
        /// 𝓑f of each term, with its force f: `normal_velocity_bending`, … They add up to the normal velocity.
        NormalVelocities = "normal-velocities",
    }
}

fn default_frames() -> usize {
    200
}

fn default_spacing() -> Spacing {
    Spacing::Linear
}

impl Default for Output {
    fn default() -> Self {
        let frames = Frames::Spaced { frames: default_frames(), spacing: default_spacing() };
        Self { frames, fields: Vec::new() }
    }
}

impl Output {
    /// `end` is the end time, if that is known.
    pub(super) fn read(mut section: Section<'_>, end: Option<f64>) -> Option<Self> {
        let (frames, spacing, times) = (section.get("frames"), section.get("spacing"), section.get("times"));
        let fields = section.get("fields").map_or(Some(Vec::new()), |entry| read_fields(&entry));
        let count = frames.as_ref().map_or(Some(default_frames()), read_count);
        let spaced = spacing.as_ref().map_or(Some(default_spacing()), Entry::choice);
        if times.is_some() {
            for key in ["frames", "spacing"].into_iter().filter(|key| section.has(key)) {
                let remedy = "keep `times` alone, or `frames` with `spacing`";
                section.fault(key, Fault::Conflict { with: "output.times", remedy });
            }
        }
        section.finish();
        let frames = match times {
            Some(times) => Frames::At { times: read_times(&times, end)? },
            None => Frames::Spaced { frames: count?, spacing: spaced? },
        };
        Some(Self { frames, fields: fields? })
    }
}

/// The names in order, each once.
fn read_fields(entry: &Entry<'_>) -> Option<Vec<OutputField>> {
    let list = entry.list("a list of names")?;
    let all: Vec<Option<OutputField>> = list.iter().map(Entry::choice).collect();
    let mut fields = Vec::new();
    for field in all.into_iter().collect::<Option<Vec<_>>>()? {
        if !fields.contains(&field) {
            fields.push(field);
        }
    }
    Some(fields)
}

fn read_count(entry: &Entry<'_>) -> Option<usize> {
    entry.integer(COUNT, "try 200, the default").map(|count| count as usize)
}

fn read_times(entry: &Entry<'_>, end: Option<f64>) -> Option<Vec<f64>> {
    let list = entry.list("a list of times")?;
    if !(1..=MAX_FRAMES).contains(&list.len()) {
        entry.fault(Fault::WrongCount { count: list.len(), bound: COUNT, remedy: "try times = [0.1, 1.0]" });
        return None;
    }
    let bound = end.map_or(Bound::AtLeast(0.0), |end| Bound::Between(0.0, end));
    let times: Vec<Option<f64>> =
        list.iter().map(|entry| entry.number(bound, "frames lie between 0 and time.end")).collect();
    let times = times.into_iter().collect::<Option<Vec<f64>>>()?;
    if let Some(pair) = times.windows(2).find(|pair| pair[0] >= pair[1]) {
        entry.fault(Fault::NotIncreasing { value: pair[1], previous: pair[0] });
        return None;
    }
    Some(times)
}
