//! The JSON Schema of a scene says what the reader says: every key, range, list of names, default and type of the one is
//! put to the other.

use std::collections::BTreeSet;

use flow_core::run::scene::{Fault, Problem, Scene};
use serde_json::Value;

const SMALL: &str = "
curve = { shape = 'circle', radius = 1 }
time.end = 1e6
[energy.bending]
rigidity = 1
[[density]]
name = 'protein'
initial = 1
mobility = 'none'
";

/// A key that no table has.
const UNKNOWN: &str = "zzz";

/// A table of a scene, with all that may stand in it.
struct Table {
    /// Its dotted path; empty for the scene itself.
    path: String,
    /// Whether it is one of a list.
    listed: bool,
    /// The shape, for a curve.
    shape: Option<String>,
    /// Its alternatives; most tables have one.
    alternatives: Vec<Value>,
}

impl Table {
    /// Path of a key in problems.
    fn key(&self, key: &str) -> String {
        match (self.path.as_str(), self.listed) {
            ("", _) => key.to_owned(),
            (path, false) => format!("{path}.{key}"),
            (path, true) => format!("{path}.0.{key}"),
        }
    }

    /// The problems of a scene with this table holding these keys only, besides the shape of a curve.
    fn problems(&self, content: &[(&str, &str)]) -> Vec<Problem> {
        let lines: Vec<String> = content.iter().map(|(key, value)| format!("{key} = {value}")).collect();
        let shape = self.shape.iter().map(|shape| format!("shape = '{shape}'"));
        let inner = format!("{{ {} }}", shape.chain(lines).collect::<Vec<_>>().join(", "));
        let changes = match (self.path.as_str(), self.listed) {
            ("", _) => content.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect(),
            (path, false) => vec![(path.to_owned(), inner)],
            (path, true) => vec![(path.to_owned(), format!("[{inner}]"))],
        };
        match Scene::parse_with(SMALL, "test.toml", &changes) {
            Ok(_) => Vec::new(),
            Err(error) if error.problems().is_empty() => panic!("{error}"),
            Err(flow_core::run::SceneError::Invalid { problems, .. }) => problems,
            Err(error) => panic!("{error}"),
        }
    }

    /// What is wrong at `key`, or inside it, if it has this value.
    fn faults(&self, key: &str, value: &str) -> Vec<Fault> {
        let path = self.key(key);
        let inside = |problem: &Problem| problem.key == path || problem.key.starts_with(&format!("{path}."));
        self.problems(&[(key, value)]).into_iter().filter(inside).map(|problem| problem.fault).collect()
    }

    /// Keys with their schemas, over all alternatives.
    fn keys(&self) -> impl Iterator<Item = (&String, &Value)> {
        self.alternatives.iter().flat_map(|table| {
            assert_eq!(table["additionalProperties"], false, "{}", self.path);
            table["properties"].as_object().expect("a table has keys")
        })
    }
}

fn tables() -> Vec<Table> {
    let mut tables = Vec::new();
    collect("", false, &Scene::schema(), &mut tables);
    assert!(tables.len() > 20, "{}", tables.len());
    tables
}

fn collect(path: &str, listed: bool, schema: &Value, tables: &mut Vec<Table>) {
    let alternatives = schema["anyOf"].as_array().cloned().unwrap_or_else(|| vec![schema.clone()]);
    for alternative in alternatives {
        for (key, inner) in alternative["properties"].as_object().expect("a table has keys") {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            for (schema, listed) in [(inner, false), (&inner["items"], true)] {
                if schema["type"] == "object" || schema["anyOf"][0]["type"] == "object" {
                    collect(&path, listed, schema, tables);
                }
            }
        }
        let shape = alternative.pointer("/properties/shape/const").and_then(Value::as_str).map(str::to_owned);
        if let Some(table) = tables.iter_mut().find(|table| table.path == path && table.shape == shape) {
            table.alternatives.push(alternative);
            continue;
        }
        tables.push(Table { path: path.to_owned(), listed, shape, alternatives: vec![alternative] });
    }
}

fn set<T: AsRef<str>>(names: impl IntoIterator<Item = T>) -> BTreeSet<String> {
    names.into_iter().map(|name| name.as_ref().to_owned()).collect()
}

fn required(table: &Value) -> BTreeSet<String> {
    set(table["required"].as_array().into_iter().flatten().filter_map(Value::as_str))
}

#[test]
fn keys_are_those_of_the_reader() {
    for table in tables() {
        let faults = table.faults(UNKNOWN, "1");
        let [Fault::UnknownKey { allowed, .. }] = faults.as_slice() else {
            panic!("{}: {faults:?}", table.path);
        };
        assert_eq!(set(table.keys().map(|(key, _)| key)), set(allowed), "{} {:?}", table.path, table.shape);
    }
}

#[test]
fn required_keys_are_those_of_the_reader() {
    for table in tables() {
        let missing = |problem: &Problem| match problem.fault {
            Fault::MissingKey { .. } => problem.key.rsplit('.').next().map(str::to_owned),
            _ => None,
        };
        let [only] = table.alternatives.as_slice() else { continue };
        if table.path.is_empty() || table.path == "energy" {
            continue;
        }
        let mut expected = required(only);
        expected.remove("shape");
        let found = set(table.problems(&[]).iter().filter_map(missing));
        assert_eq!(found, expected, "{} {:?}", table.path, table.shape);
    }
}

/// The schemas of single values that may stand at a key.
fn values(schema: &Value) -> Vec<Value> {
    schema["anyOf"].as_array().cloned().unwrap_or_else(|| vec![schema.clone()])
}

/// A list of as many numbers as a schema wants, each of them `value`.
fn list_of(value: &str, schema: &Value) -> String {
    let count = schema["minItems"].as_u64().unwrap_or(1) as usize;
    format!("[{}]", vec![value; count].join(", "))
}

#[test]
fn ranges_are_those_of_the_reader() {
    let outside = |fault: &Fault| matches!(fault, Fault::OutOfRange { .. } | Fault::ValueOutOfRange { .. });
    let mut seen = 0;
    for table in tables() {
        for (key, schema) in table.keys() {
            for value in values(schema) {
                let (range, listed) = if value["items"]["type"] == "number" {
                    (&value["items"], true)
                } else {
                    (&value, false)
                };
                let integer = range["type"] == "integer";
                let number = |keyword: &str| range[keyword].as_f64();
                let step = |bound: f64| if integer { 1.0 } else { bound.abs().max(1e-9) * 1e-3 };
                if !(integer || range["type"] == "number" || range["type"][0] == "number") {
                    continue;
                }
                let least = number("minimum").map(|least| (least, Some(least - step(least))));
                let above = number("exclusiveMinimum").map(|bound| (bound + 1e-300, Some(bound)));
                let most = number("maximum").map(|most| (most, Some(most + step(most))));
                let only = number("const").map(|only| (only, Some(only + 1.0)));
                // Inside and outside of each end of the range; an open end allows large numbers (before the end of the run).
                let lower = only.or(least).or(above).unwrap_or((-1e5, None));
                let upper = only.or(most).unwrap_or((1e5, None));
                for (inside, beyond) in [lower, upper] {
                    let written = |x: f64| if integer { format!("{x:.0}") } else { format!("{x:e}") };
                    let written = |x: f64| if listed { list_of(&written(x), &value) } else { written(x) };
                    let at = format!("{}: {inside:e} or {beyond:?}", table.key(key));
                    assert!(!table.faults(key, &written(inside)).iter().any(outside), "{at}");
                    if let Some(beyond) = beyond {
                        assert!(table.faults(key, &written(beyond)).iter().any(outside), "{at}");
                    }
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 80, "{seen}");
}

#[test]
fn numbers_of_entries_are_those_of_the_reader() {
    let miscounted = |fault: &Fault| matches!(fault, Fault::WrongCount { .. });
    let mut seen = 0;
    for table in tables() {
        for (key, schema) in table.keys() {
            let entry =
                |i: u64| if schema["items"]["type"] == "array" { format!("[{i}, 1]") } else { i.to_string() };
            let list = |count: u64| format!("[{}]", (1..=count).map(entry).collect::<Vec<_>>().join(", "));
            let Some(most) = schema["maxItems"].as_u64() else { continue };
            let at = table.key(key);
            if let Some(least) = schema["minItems"].as_u64() {
                assert!(!table.faults(key, &list(least)).iter().any(miscounted), "{at}");
                assert!(table.faults(key, &list(least - 1)).iter().any(miscounted), "{at}");
            }
            assert!(table.faults(key, &list(most + 1)).iter().any(miscounted), "{at}");
            seen += 1;
        }
    }
    assert_eq!(seen, 6);
}

#[test]
fn names_are_those_of_the_reader() {
    let mut seen = 0;
    for table in tables() {
        for (key, schema) in table.keys() {
            for (schema, value) in
                [(schema, format!("'{UNKNOWN}'")), (&schema["items"], format!("['{UNKNOWN}']"))]
            {
                let Some(names) = schema["oneOf"].as_array() else { continue };
                let faults = table.faults(key, &value);
                let Some(Fault::UnknownName { allowed, .. }) = faults.first() else {
                    panic!("{key}: {faults:?}")
                };
                let names: Vec<&str> = names.iter().map(|name| name["const"].as_str().unwrap()).collect();
                assert_eq!(&names, allowed, "{}", table.key(key));
                seen += 1;
            }
        }
    }
    assert_eq!(seen, 9);
}

#[test]
fn every_key_has_a_meaning_and_a_type() {
    for table in tables() {
        for (key, schema) in table.keys().filter(|(key, _)| *key != "shape") {
            assert!(
                schema["description"].as_str().is_some_and(|text| text.ends_with('.')),
                "{}",
                table.key(key)
            );
            let wrong = |fault: &Fault| matches!(fault, Fault::WrongType { .. });
            // For a title, that is text.
            let other = if key == "title" { "[1]" } else { "1979-05-27" };
            assert!(table.faults(key, other).iter().any(wrong), "{}", table.key(key));
        }
    }
}

#[test]
fn defaults_are_those_of_the_reader() {
    let mut seen = 0;
    for table in tables().iter().filter(|table| !table.listed && !table.path.starts_with("energy")) {
        for alternative in &table.alternatives {
            if let Some(shape) = &table.shape
                && shape != "figure-eight"
                && shape != "trillium"
            {
                continue;
            }
            let mut text = SMALL.to_owned();
            if let Some(shape) = &table.shape {
                text = text.replace("'circle', radius = 1", &format!("'{shape}'"));
            }
            let resolved: toml::Table = Scene::parse(&text, "test.toml").unwrap().to_toml().parse().unwrap();
            let resolved = serde_json::to_value(resolved).unwrap();
            for (key, schema) in alternative["properties"].as_object().unwrap() {
                let Some(default) = schema.get("default") else { continue };
                let found = format!("/{}", table.key(key).replace('.', "/"));
                assert_eq!(resolved.pointer(&found), Some(default), "{found}");
                seen += 1;
            }
        }
    }
    assert_eq!(seen, 17);
}
