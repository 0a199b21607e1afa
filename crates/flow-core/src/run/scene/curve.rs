//! `[curve]`: the initial curve, counter-clockwise.

use schemars::transform::Transform;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::{Value, json};

use super::entry::Entry;
use super::error::{Bound, Fault};
use super::formula::Formula;
use super::keywords::{Each, Entries, Within};
use super::points;
use super::section::Section;

/// Fewer points do not say what the curve is.
const MIN_POINTS: usize = 8;
/// As many points still fit into a scene when it is written out.
const MAX_POINTS: usize = 16_384;
const SHAPES: [&str; 7] = ["circle", "ellipse", "trillium", "polar", "parametric", "points", "figure-eight"];
const ANGLE: &[&str] = &["phi"];

/// The initial curve.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(transform = by_shape)]
pub struct Curve {
    /// Its shape.
    #[serde(flatten)]
    pub shape: Shape,
    /// Turning number ω = ∫κ dσ / 2π: 1 unless given, 0 for the figure eight. What the shape measures must agree.
    pub turning_number: i32,
}

/// The shapes, by their name under `shape`. Angles φ run over `[0, 2π)`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Shape {
    /// A circle about the origin.
    Circle {
        /// Radius > 0.
        #[schemars(transform = Within(Bound::Positive))]
        radius: f64,
    },
    /// An ellipse with its axes along x and y.
    Ellipse {
        /// Semi-axes along x and y, both > 0.
        #[schemars(transform = Each(Bound::Positive))]
        semi_axes: [f64; 2],
    },
    /// `(x, y) = r (cos φ, sin φ) + (0.05 sin 4φ, 0)` with `r = 1 + 0.35 cos 3φ`: the curve of the paper's figures.
    Trillium {},
    /// `(x, y) = r(φ) (cos φ, sin φ)`.
    Polar {
        /// Radius, an expression of `phi`.
        r: Formula,
    },
    /// `(x, y) = (x(φ), y(φ))`.
    Parametric {
        /// First coordinate, an expression of `phi`.
        x: Formula,
        /// Second coordinate, an expression of `phi`.
        y: Formula,
    },
    /// A closed curve through points; the first may be repeated at the end, where it does not count.
    Points {
        /// The points in order, 8 to 16384 of them, and perhaps the first again; read from `file` if the scene names one.
        #[schemars(transform = Entries(MIN_POINTS, MAX_POINTS + 1))]
        points: Vec<[f64; 2]>,
    },
    /// A symmetric figure eight, turning number 0.
    FigureEight {
        /// Half its width, > 0; 1 unless given.
        #[schemars(default = "default_size", transform = Within(Bound::Positive))]
        size: f64,
    },
}

impl Curve {
    /// How many points it goes through, if it goes through points.
    #[must_use]
    pub fn points(&self) -> Option<usize> {
        match &self.shape {
            Shape::Points { points } => Some(points.len()),
            _ => None,
        }
    }

    pub(super) fn read(mut section: Section<'_>) -> Option<Self> {
        let shape = section.required("shape", "shape = \"circle\"");
        let name = shape.as_ref().and_then(Entry::text);
        let Some(name) = name else {
            // Without a shape there is no telling which other keys belong here: ask for all, so that none is unknown.
            for key in ["radius", "semi_axes", "r", "x", "y", "points", "file", "size", "turning_number"] {
                section.get(key);
            }
            section.finish();
            return None;
        };
        let read = match name {
            "circle" => circle(&mut section),
            "ellipse" => ellipse(&mut section),
            "trillium" => Some(Shape::Trillium {}),
            "polar" => polar(&mut section),
            "parametric" => parametric(&mut section),
            "points" => through_points(&mut section),
            "figure-eight" => figure_eight(&mut section),
            unknown => {
                shape?.not_a_choice(unknown, SHAPES.to_vec());
                return None;
            }
        };
        let (expected, bound) = turning_numbers(name);
        let remedy = "a simple closed curve turns once; drop the key for the number of this shape";
        let turning_number = section.get("turning_number");
        section.finish();
        let turning_number = match turning_number {
            Some(entry) => entry.integer(bound, remedy)? as i32,
            None => expected,
        };
        Some(Self { shape: read?, turning_number })
    }
}

/// Turning number of a shape if the scene gives none, and those that it may give.
fn turning_numbers(shape: &str) -> (i32, Bound) {
    match shape {
        "figure-eight" => (0, Bound::Exactly(0.0)),
        "circle" | "ellipse" | "trillium" => (1, Bound::Exactly(1.0)),
        _ => (1, Bound::Between(0.0, 16.0)),
    }
}

/// The turning numbers that go with each shape, and the file that can stand for points.
fn by_shape(schema: &mut Schema) {
    let turning_number = schema.pointer("/properties/turning_number").cloned();
    schema.remove("properties");
    schema.remove("required");
    let Some(Value::Array(shapes)) = schema.get_mut("oneOf") else { unreachable!("one of the shapes") };
    for shape in shapes.iter_mut() {
        let name = shape.pointer("/properties/shape/const").and_then(Value::as_str);
        let (default, bound) = turning_numbers(name.expect("a shape has a name"));
        shape["properties"]["turning_number"] = turning_number.clone().into();
        let turning_number: &mut Schema =
            (&mut shape["properties"]["turning_number"]).try_into().expect("a key has a schema");
        Within(bound).transform(turning_number);
        turning_number.insert("default".to_owned(), default.into());
    }
    let points = shapes.iter().find(|shape| shape["properties"].get("points").is_some());
    let mut file = points.expect("points are a shape").clone();
    let description =
        "File of the points, one on each line, x and y; looked for from the folder of the scene.";
    file["required"] = json!(["shape", "file"]);
    let keys = file["properties"].as_object_mut().expect("a shape has keys");
    keys.remove("points");
    keys.insert("file".to_owned(), json!({ "type": "string", "description": description }));
    shapes.push(file);
}

fn circle(section: &mut Section<'_>) -> Option<Shape> {
    let radius = section.required("radius", "radius = 1.0");
    Some(Shape::Circle { radius: radius?.number(Bound::Positive, "try radius = 1.0")? })
}

fn ellipse(section: &mut Section<'_>) -> Option<Shape> {
    let semi_axes = section.required("semi_axes", "semi_axes = [2.0, 1.0]");
    Some(Shape::Ellipse { semi_axes: semi_axes?.pair(Bound::Positive, "try semi_axes = [2.0, 1.0]")? })
}

fn polar(section: &mut Section<'_>) -> Option<Shape> {
    let r = section.required("r", "r = \"1 + 0.35*cos(3*phi)\"");
    Some(Shape::Polar { r: r?.formula(ANGLE)? })
}

fn parametric(section: &mut Section<'_>) -> Option<Shape> {
    let x = section.required("x", "x = \"2*cos(phi)\"").and_then(|entry| entry.formula(ANGLE));
    let y = section.required("y", "y = \"sin(phi)\"").and_then(|entry| entry.formula(ANGLE));
    Some(Shape::Parametric { x: x?, y: y? })
}

fn figure_eight(section: &mut Section<'_>) -> Option<Shape> {
    let size = section
        .get("size")
        .map_or(Some(default_size()), |entry| entry.number(Bound::Positive, "try size = 1.0"));
    Some(Shape::FigureEight { size: size? })
}

fn default_size() -> f64 {
    1.0
}

fn through_points(section: &mut Section<'_>) -> Option<Shape> {
    if section.has("file") {
        let file = section.get("file")?;
        if section.get("points").is_some() {
            section.fault("points", Fault::Conflict { with: "curve.file", remedy: "keep one of the two" });
        }
        return checked(&file, from_file(&file)?);
    }
    let list = section.required("points", "file = \"points.txt\", or points = [[1.0, 0.0], [0.9, 0.4], …]");
    section.get("file");
    let list = list?;
    let read = |entry: &Entry<'_>| entry.pair(Bound::Finite, "write each point as [x, y]");
    // All points are read before the first failure counts, so that all are reported.
    let points: Vec<Option<[f64; 2]>> = list.list("a list of points [x, y]")?.iter().map(read).collect();
    checked(&list, points.into_iter().collect::<Option<_>>()?)
}

fn from_file(entry: &Entry<'_>) -> Option<Vec<[f64; 2]>> {
    let file = entry.folder().join(entry.text()?);
    match points::read(&file) {
        Ok(points) => Some(points),
        Err(source) => {
            entry.fault(Fault::Points { file, source });
            None
        }
    }
}

fn checked(entry: &Entry<'_>, mut points: Vec<[f64; 2]>) -> Option<Shape> {
    // Many programs repeat the first point to close the curve.
    if points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    if !(MIN_POINTS..=MAX_POINTS).contains(&points.len()) {
        let bound = Bound::Between(MIN_POINTS as f64, MAX_POINTS as f64);
        let remedy = "sample the curve where it bends most; between the points it is interpolated";
        entry.fault(Fault::WrongCount { count: points.len(), bound, remedy });
        return None;
    }
    if let Some(index) = points.windows(2).position(|pair| pair[0] == pair[1]) {
        entry.fault(Fault::RepeatedPoint { index, value: points[index] });
        return None;
    }
    Some(Shape::Points { points })
}
