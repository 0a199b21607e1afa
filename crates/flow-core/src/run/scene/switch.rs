//! `[[flow.switch]]`: changes of the gauge on the way.

use schemars::JsonSchema;
use serde::Serialize;

use super::entry::Entry;
use super::error::{Bound, Fault};
use super::formula::Formula;
use super::gauge::Gauge;
use super::keywords::Within;
use super::section::Section;

/// More than this are more likely a slip than a wish.
pub(super) const MAX_SWITCHES: usize = 100;

/// A change of the gauge; the curve is the same, its nodes lie elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Switch {
    /// When, in `[0, end]`; the run makes a step end there.
    #[schemars(transform = Within(Bound::AtLeast(0.0)))]
    pub time: f64,
    /// The gauge from then on.
    pub gauge: Gauge,
    /// Its metric, as `flow.grading`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(transform = Within(Bound::Positive))]
    pub grading: Option<Formula>,
}

impl Switch {
    /// Reads all tables; `end` is the end time, if that is known.
    pub(super) fn read_all(entry: Option<Entry<'_>>, end: Option<f64>) -> Vec<Self> {
        let Some(list) = entry else { return Vec::new() };
        let entries = list.list("a list of tables").unwrap_or_default();
        if entries.len() > MAX_SWITCHES {
            let bound = Bound::Between(0.0, MAX_SWITCHES as f64);
            let remedy =
                "keep those that the solution needs: each switch adds an error and restarts the method";
            list.fault(Fault::WrongCount { count: entries.len(), bound, remedy });
            return Vec::new();
        }
        let mut switches: Vec<Self> = Vec::new();
        for entry in entries {
            let previous = switches.last().map(|switch| switch.time);
            let read = |entry: Entry<'_>| Self::read(entry.section()?, previous, end);
            switches.extend(read(entry));
        }
        switches
    }

    fn read(mut section: Section<'_>, previous: Option<f64>, end: Option<f64>) -> Option<Self> {
        let bound = end.map_or(Bound::AtLeast(0.0), |end| Bound::Between(0.0, end));
        let time = section.required("time", "time = 0.1").and_then(|entry| {
            let time = entry.number(bound, "a run switches between its start and time.end")?;
            match previous.filter(|previous| time <= *previous) {
                Some(previous) => {
                    entry.fault(Fault::NotIncreasing { value: time, previous });
                    None
                }
                None => Some(time),
            }
        });
        if !section.has("gauge") {
            section.fault("gauge", Fault::MissingKey { example: "gauge = \"scaled-arc-length\"" });
        }
        let (gauge, grading) = Gauge::read(&mut section);
        section.finish();
        Some(Self { time: time?, gauge: gauge?, grading })
    }
}
