//! The data of a page: names and texts as JSON, numbers as base64 that names say how to read.

use super::{base64, facts, json, plane};
use crate::output::drawn::energy_over_time;
use crate::run::{Frame, Record};

/// Steps that the page shows at most: more than a screen has pixels.
const STEPS: usize = 4000;

/// What a page holds besides its program.
pub(super) struct Payload {
    /// Names, texts and tables.
    pub summary: String,
    /// The middle of the curve in every frame.
    pub centres: String,
    /// Position of every node in every frame, from the middle of the curve: single precision does not reach far.
    pub positions: String,
    /// Every field after the other, each frame by frame.
    pub fields: String,
    /// Every value per frame after the other.
    pub history: String,
    /// Times of the frames and of the steps, then the energies there.
    pub energies: String,
}

impl Payload {
    pub fn new(record: &Record) -> Self {
        let (fields, history) = (fields(record), history(record));
        let frames = &record.frames;
        let every = record.steps.time.len().div_ceil(STEPS);
        let energies = energy_over_time(frames, &record.steps, every.max(1));
        let centres: Vec<[f64; 2]> = frames.iter().map(centre).collect();
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
            positions: base64::singles(frames.iter().zip(&centres).flat_map(|(frame, centre)| {
                frame.position.iter().flat_map(move |at| [at[0] - centre[0], at[1] - centre[1]])
            })),
            centres: base64::doubles(centres.iter().flatten().copied()),
            fields: base64::singles(
                fields
                    .iter()
                    .flat_map(|field| frames.iter().flat_map(|frame| (field.get)(frame).iter().copied())),
            ),
            history: base64::doubles(history.iter().flat_map(|value| of_frames(&value.get))),
            energies: base64::doubles([0, 1].iter().flat_map(|&k| energies.iter().map(move |at| at[k]))),
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

/// The middle of the positions that are finite.
fn centre(frame: &Frame) -> [f64; 2] {
    [0, 1].map(|axis| {
        let values = || frame.position.iter().map(|at| at[axis]).filter(|value| value.is_finite());
        let (low, high) =
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        if low > high { 0.0 } else { 0.5 * low + 0.5 * high }
    })
}
