//! What `curveflow check` says of runs that do not fit.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::process::{Command, Output};

fn check(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_curveflow")).arg("check").args(arguments).output().unwrap()
}

#[test]
fn frames_that_become_too_many_are_warned_of() {
    let changes = [
        "accuracy.nodes='auto'",
        "energy.agents.epsilon=0.005",
        "energy.agents.delta=0.02",
        "output.frames=100000",
    ];
    let arguments: Vec<&str> =
        ["three_fold"].into_iter().chain(changes.iter().flat_map(|change| ["--set", *change])).collect();
    let output = check(&arguments);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    let warning = text.lines().find(|line| line.starts_with("warning") && line.contains("100001 frames"));
    assert!(warning.is_some_and(|line| line.contains("16.00 GB are allowed")), "{text}");
}

#[test]
fn a_run_that_fits_is_not_warned_of() {
    let output = check(&["circle"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && !text.contains("warning"), "{text}");
    let json: serde_json::Value = serde_json::from_slice(&check(&["circle", "--json"]).stdout).unwrap();
    assert_eq!(json["warnings"], serde_json::json!([]));
}

#[test]
fn more_pairs_of_nodes_than_allowed_are_refused_at_once() {
    let clock = std::time::Instant::now();
    let output = check(&["adhesion", "--set", "accuracy.nodes=65536"]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("pairs of 65536 nodes") && text.contains("try 16384 nodes"), "{text}");
    assert!(clock.elapsed().as_secs_f64() < 20.0, "{:?}", clock.elapsed());
}

#[test]
fn terms_that_move_nothing_are_named() {
    let warnings = |mobility: &str| {
        let change = format!("flow.normal_mobility={mobility}");
        let terms = ["energy.area={ penalty = 1.0, target_ratio = 0.9 }", "energy.length.tension=1.0"];
        let set = [
            "length_penalty",
            "--json",
            "--set",
            &change,
            "--set",
            "energy.length=",
            "--set",
            terms[0],
            "--set",
            terms[1],
        ];
        let output = check(&set);
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        json["warnings"]
            .as_array()
            .unwrap()
            .iter()
            .map(|text| text.as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert!(warnings("identity").is_empty());
    for (mobility, keys) in [
        ("incompressible", &["length"][..]),
        ("area-preserving", &["area"]),
        ("surface-diffusion", &["area"]),
        ("incompressible-area-preserving", &["length", "area"]),
    ] {
        let found = warnings(mobility);
        assert_eq!(found.len(), keys.len(), "{found:?}");
        let named =
            found.iter().zip(keys).all(|(text, key)| text.contains(&format!("energy.{key} moves nothing")));
        assert!(named, "{found:?}");
    }
}
