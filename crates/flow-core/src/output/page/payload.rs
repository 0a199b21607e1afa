//! The data of a page: names and texts as JSON, numbers as base64 that names say how to read.

use super::{base64, facts, json, plane};
use crate::run::{Frame, Record};

/// Steps that the page shows at most: more than a screen has pixels.
const STEPS: usize = 4000;

/// What a page holds besides its program.
pub(super) struct Payload {
    /// Names, texts and tables.
    pub summary: String,
    /// Position of every node in every frame.
    pub positions: String,
    /// Every field after the other, each frame by frame.
    pub fields: String,
    /// Every value per frame after the other.
    pub history: String,
    /// Time of the steps, then their energy.
    pub steps: String,
}

impl Payload {
    pub fn new(record: &Record) -> Self {
        let (fields, history) = (fields(record), history(record));
        let frames = &record.frames;
        let every = record.steps.time.len().div_ceil(STEPS).max(1);
        let steps = thinned(&record.steps.time, every).chain(thinned(&record.steps.energy, every));
        let names = |names: &mut dyn Iterator<Item = &str>| json::list(names.map(json::text));
        let summary = json::object([
            ("title", json::text(&record.title)),
            ("status", json::text(record.stop_reason.name())),
            ("message", json::text(record.stop_reason.message())),
            ("version", json::text(env!("CARGO_PKG_VERSION"))),
            ("scene", json::text(&record.scene)),
            ("resolvedScene", json::text(&record.resolved_scene)),
            ("frames", frames.len().to_string()),
            ("nodes", record.nodes().to_string()),
            ("everyStep", every.to_string()),
            ("densities", names(&mut record.densities.iter().map(String::as_str))),
            ("fields", names(&mut fields.iter().map(|field| field.name.as_str()))),
            ("history", names(&mut history.iter().map(|value| value.name.as_str()))),
            ("plane", plane::lines(record)),
            ("tables", facts::tables(record)),
        ]);
        let of_frames = |get: &dyn Fn(&Frame) -> f64| frames.iter().map(get).collect::<Vec<_>>();
        Self {
            summary,
            positions: base64::singles(
                frames.iter().flat_map(|frame| frame.position.iter().flatten().copied()),
            ),
            fields: base64::singles(
                fields
                    .iter()
                    .flat_map(|field| frames.iter().flat_map(|frame| (field.get)(frame).iter().copied())),
            ),
            history: base64::doubles(history.iter().flat_map(|value| of_frames(&value.get))),
            steps: base64::doubles(steps),
        }
    }
}

/// Something with a name that every frame holds.
struct Named<Get: ?Sized> {
    name: String,
    get: Box<Get>,
}

type Field = Named<dyn Fn(&Frame) -> &[f64]>;
type Value = Named<dyn Fn(&Frame) -> f64>;

/// Densities come first: they are what the page colours the curve by unless told otherwise.
fn fields(record: &Record) -> Vec<Field> {
    let mut fields: Vec<Field> = Vec::new();
    for (k, name) in record.densities.iter().enumerate() {
        fields
            .push(Named {
                name: format!("{name} density ρ"), get: Box::new(move |frame| &frame.density[k])
            });
    }
    fields.extend([
        Field { name: "curvature κ".to_owned(), get: Box::new(|frame| &frame.curvature) },
        Field { name: "normal velocity V".to_owned(), get: Box::new(|frame| &frame.normal_velocity) },
        Field { name: "metric g".to_owned(), get: Box::new(|frame| &frame.metric) },
    ]);
    for (k, name) in record.fields.iter().enumerate() {
        fields.push(Named { name: name.clone(), get: Box::new(move |frame| &frame.fields[k]) });
    }
    fields
}

/// Time, energy and length come first, in this order.
fn history(record: &Record) -> Vec<Value> {
    let value = |name: &str, get: fn(&Frame) -> f64| Value { name: name.to_owned(), get: Box::new(get) };
    let mut history = vec![
        value("time", |frame| frame.time),
        value("energy", |frame| frame.energy),
        value("length", |frame| frame.length),
        value("dissipation", |frame| frame.dissipation),
        value("energy balance", |frame| frame.energy_balance),
        value("area", |frame| frame.area),
        value("gap at closure", |frame| frame.closure_defect),
        value("self-crossings", |frame| frame.crossings),
    ];
    for (k, name) in record.energy_terms.iter().enumerate() {
        history.push(Named {
            name: format!("energy of {name}"),
            get: Box::new(move |frame| frame.energy_terms[k]),
        });
    }
    for (k, name) in record.densities.iter().enumerate() {
        history.push(Named { name: format!("mass of {name}"), get: Box::new(move |frame| frame.mass[k]) });
    }
    for (k, name) in record.diagnostics.iter().enumerate() {
        history.push(Named { name: name.clone(), get: Box::new(move |frame| frame.diagnostics[k]) });
    }
    history
}

/// Each value of number `every`, and the last.
fn thinned(values: &[f64], every: usize) -> impl Iterator<Item = f64> {
    let last = values.len().saturating_sub(1);
    values.iter().enumerate().filter(move |(k, _)| k % every == 0 || *k == last).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_log_keeps_its_ends() {
        let values: Vec<f64> = (0..10).map(f64::from).collect();
        assert_eq!(thinned(&values, 4).collect::<Vec<_>>(), [0.0, 4.0, 8.0, 9.0]);
        assert_eq!(thinned(&values, 1).count(), 10);
        assert_eq!(thinned(&[], 1).count(), 0);
    }
}
