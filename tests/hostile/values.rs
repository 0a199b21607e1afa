//! Every value of a scene in turn becomes one that nobody should write: the scene is refused with a message, or it sets
//! up and runs, or fails with a message. Nothing panics, and nothing takes all memory.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::collections::BTreeSet;
use std::panic::catch_unwind;

use curveflow_tests::hostile::short_run;
use flow_core::run::Scene;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::Value as Json;
use toml::Value;

/// Small scenes that between them name every key; the fuzzer starts from them too.
const SCENES: [&str; 7] = [
    include_str!("../../fuzz/seeds/scene/adhesion.toml"),
    include_str!("../../fuzz/seeds/scene/agents.toml"),
    include_str!("../../fuzz/seeds/scene/bending.toml"),
    include_str!("../../fuzz/seeds/scene/circle.toml"),
    include_str!("../../fuzz/seeds/scene/incompressible.toml"),
    include_str!("../../fuzz/seeds/scene/membrane.toml"),
    include_str!("../../fuzz/seeds/scene/points.toml"),
];
/// As TOML.
const NUMBERS: [&str; 25] = [
    "8",
    "nan",
    "inf",
    "-inf",
    "0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "5e-324",
    "-5e-324",
    "1e-308",
    "1e-162",
    "1e-16",
    "1e16",
    "1e154",
    "1e308",
    "-1e308",
    "1e-400",
    "1e400",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999999999",
    "0xffffffffffffffffff",
    "2147483648",
];
const OTHERS: [&str; 9] = [
    "''",
    "' '",
    "'\u{202e}κ\u{0301}💧'",
    "'\\u0000'",
    "true",
    "[]",
    "{}",
    "[[[[[[]]]]]]",
    "1979-05-27T07:32:00Z",
];
const FORMULAS: [&str; 14] = [
    "'1/0'",
    "'0/0'",
    "'1e308*1e308'",
    "'-1'",
    "'1e-308'",
    "'1e308'",
    "'ln(-1)'",
    "'exp(1000)'",
    "'sqrt(s - 0.5)'",
    "'1/(rho - rho)'",
    "'tan(phi)^99'",
    "'exp(exp(exp(kappa)))'",
    "'abs(q)^0.5'",
    "'s^(1/3)'",
];

fn long() -> [String; 3] {
    [
        format!("'{}'", "x".repeat(100_000)),
        format!("'{}1'", "1+".repeat(50_000)),
        format!("'{}'", "(".repeat(5_000)),
    ]
}

/// Dotted keys of all values of a table, lists by index.
fn leaves(path: &str, value: &Value, out: &mut Vec<String>) {
    let within = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Table(table) => table.iter().for_each(|(key, value)| leaves(&within(key), value, out)),
        Value::Array(list) if list.iter().any(Value::is_table) => {
            list.iter().enumerate().for_each(|(k, value)| leaves(&within(&k.to_string()), value, out));
        }
        _ => out.push(path.to_owned()),
    }
}

fn keys(text: &str) -> Vec<String> {
    let table: toml::Table = toml::from_str(text).unwrap();
    let mut keys = Vec::new();
    leaves("", &Value::Table(table), &mut keys);
    keys
}

/// Reads the scene with one value changed, and runs what is accepted. Returns whether it was, and whether it ran.
fn tried(text: &str, changes: &[(String, String)]) -> [bool; 2] {
    match Scene::parse_with(text, "scene.toml", changes) {
        Ok(scene) => [true, short_run(scene).is_some()],
        Err(error) => {
            assert!(error.to_string().len() < 20_000);
            [false; 2]
        }
    }
}

fn values() -> Vec<String> {
    let short = NUMBERS.into_iter().chain(OTHERS).chain(FORMULAS).map(str::to_owned);
    short.chain(long()).collect()
}

#[test]
fn every_value_can_be_hostile() {
    let values = values();
    let [mut all, mut accepted, mut ran] = [0; 3];
    let mut panics = Vec::new();
    for text in SCENES {
        assert_eq!(tried(text, &[]), [true, true], "{text}");
        for key in keys(text) {
            for value in &values {
                let change = [(key.clone(), value.clone())];
                all += 1;
                let Ok([is_scene, is_run]) = catch_unwind(|| tried(text, &change)) else {
                    panics.push(format!("{key} = {value:.30}"));
                    continue;
                };
                accepted += usize::from(is_scene);
                ran += usize::from(is_run);
            }
        }
    }
    println!("{all} scenes, {accepted} accepted, {ran} of them ran");
    assert!(panics.is_empty(), "{} panics:\n{}", panics.len(), panics.join("\n"));
    assert!(ran > 0 && accepted < all);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, rng_seed: RngSeed::Fixed(20_261_128), ..ProptestConfig::default() })]

    /// Several at once: what each key checks alone, and what they are together.
    #[test]
    fn several_values_can_be_hostile(
        text in prop::sample::select(SCENES.to_vec()),
        picks in prop::collection::vec(any::<(prop::sample::Index, prop::sample::Index)>(), 2..5),
    ) {
        let (keys, values) = (keys(text), values());
        let changes: Vec<(String, String)> =
            picks.iter().map(|(key, value)| (key.get(&keys).clone(), value.get(&values).clone())).collect();
        tried(text, &changes);
    }
}

/// As few nodes as a scene may have, with as many densities, under every solver.
#[test]
fn the_fewest_nodes_are_enough_to_start() {
    for (nodes, densities) in (8..14).flat_map(|nodes| (0..8).map(move |densities| (nodes, densities))) {
        for solver in ["auto", "fourier", "banded", "dense"] {
            let density =
                |k| format!("{{ name = 'd{k}', initial = '0.5 + 0.1*cos(2*pi*s)', mobility = 'diffusion' }}");
            let list = (0..densities).map(density).collect::<Vec<_>>().join(", ");
            let text = format!(
                "curve = {{ shape = 'ellipse', semi_axes = [1.1, 1] }}
                density = [{list}]
                energy.bending.rigidity = 1
                time.end = 1
                accuracy = {{ nodes = {nodes}, linear_solver = '{solver}', tolerance = 1e-2 }}"
            );
            assert_eq!(tried(&text, &[]), [true, true], "{text}");
        }
    }
}

/// The scenes above name every key that there is.
#[test]
fn every_key_is_tried() {
    let mut known = BTreeSet::new();
    names(&Scene::schema(), &mut known);
    let named: BTreeSet<String> = SCENES
        .iter()
        .flat_map(|text| keys(text))
        .flat_map(|key| key.split('.').map(str::to_owned).collect::<Vec<_>>())
        .collect();
    // A file of points has its own tests.
    let missing: Vec<&String> = known.difference(&named).collect();
    assert_eq!(missing, ["file"]);
}

fn names(schema: &Json, out: &mut BTreeSet<String>) {
    if let Some(properties) = schema["properties"].as_object() {
        out.extend(properties.keys().cloned());
    }
    match schema {
        Json::Object(object) => object.values().for_each(|value| names(value, out)),
        Json::Array(list) => list.iter().for_each(|value| names(value, out)),
        _ => {}
    }
}
