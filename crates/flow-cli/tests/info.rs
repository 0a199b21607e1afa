//! What `info` says of where the time went.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;

use serde_json::Value;

use folder::Folder;

const CIRCLE: &str = "
curve = { shape = 'circle', radius = 1.0 }
energy = { bending.rigidity = 1.0, length.tension = 0.1 }
time = { end = 0.1, stop_at_equilibrium = false }
accuracy = { tolerance = 1e-3, nodes = 32 }
output.frames = 2
";

fn said(folder: &Folder, args: &[&str]) -> String {
    let output = folder.call(args);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(folder: &Folder, args: &[&str]) -> Value {
    serde_json::from_slice(&folder.call(args).stdout).unwrap()
}

fn sum(seconds: &Value) -> f64 {
    seconds.as_object().unwrap().values().map(|value| value.as_f64().unwrap()).sum()
}

#[test]
fn info_tells_where_the_time_went() {
    let folder = Folder::empty("info");
    fs::write(folder.0.join("circle.toml"), CIRCLE).unwrap();
    let run: Value = serde_json::from_str(&said(&folder, &["run", "circle.toml", "--json"])).unwrap();

    let text = said(&folder, &["info", "circle.h5"]);
    for part in
        ["try: ", "energy.bending", "energy.length", "output", "rejected: ", "Krylov iterations per solve"]
    {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }

    let info: Value = serde_json::from_str(&said(&folder, &["info", "circle.h5", "--json"])).unwrap();
    let total = info["seconds_total"].as_f64().unwrap();
    assert!(total > 0.0 && (sum(&info["seconds"]) - total).abs() < 1e-9 * total);
    assert!(info["evaluation_seconds"]["bending"].is_number());
    for key in ["limit", "why_slow", "advice"] {
        assert!(!info[key].as_str().unwrap().is_empty(), "{key}");
    }
    // The file knows how long it took to make, the program that made it also how long it took to write.
    let (made, all) = (&info["seconds"]["output"], &run["seconds"]["output"]);
    assert!(0.0 < made.as_f64().unwrap() && made.as_f64().unwrap() < all.as_f64().unwrap());
}

/// Tables made of many runs have no holes.
#[test]
fn json_has_the_same_keys_however_a_run_ends() {
    let folder = Folder::empty("keys");
    fs::write(folder.0.join("circle.toml"), CIRCLE).unwrap();
    let whole = json(&folder, &["run", "circle.toml", "--json", "-o", "whole.h5"]);
    let failing = ["--set", "time.max_steps=1", "--set", "accuracy.nodes=auto"];
    let failed =
        json(&folder, &[&["run", "circle.toml", "--json", "-o", "failed.h5"], &failing[..]].concat());
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&whole), keys(&failed));
    assert_eq!((&whole["success"], &failed["success"]), (&true.into(), &false.into()));
    assert_eq!((&whole["output"], &failed["output"]), (&"whole.h5".into(), &"failed.h5".into()));
    assert_eq!(whole["message"], "the end time was reached");
    assert!(failed["advice"].as_str().unwrap().starts_with("first mend what ended the run: "));
    for none in ["remaps", "unresolved_steps", "crossings_last"] {
        assert_eq!(whole[none], 0, "{none}");
    }
    for none in ["events", "warnings", "own_terms"] {
        assert!(whole[none].as_array().unwrap().is_empty(), "{none}");
    }
    assert_eq!(json(&folder, &["info", "whole.h5", "--json"])["steps"], whole["steps"]);
}

#[test]
fn a_contact_is_told_with_its_time() {
    let folder = Folder::empty("contact");
    let scene = "curve = { shape = 'parametric', x = '2*cos(phi)', y = 'sin(phi)*(0.15 + 0.85*cos(phi)^2)' }\n\
                 energy.bending.rigidity = 0.05\nenergy.length = { penalty = 10.0, target_ratio = 1.0 }\n\
                 energy.adhesion.kernel = '-0.5*exp(-q/0.05)'\nflow.stop_on_contact = true\ntime.end = 5.0\n";
    fs::write(folder.0.join("neck.toml"), scene).unwrap();
    let output = folder.call(&["run", "neck.toml", "--set", "accuracy.tolerance=1e-5"]);
    let said_of_run = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success() && said_of_run.contains("in contact with itself: t = 1.419"),
        "{said_of_run}"
    );
    let info = json(&folder, &["info", "neck.h5", "--json"]);
    assert_eq!((&info["stop_reason"], &info["crossings_last"]), (&"contact".into(), &0.into()));
    assert_eq!(info["events"][0], format!("contact at t = {}", info["time"]));
}

#[test]
fn the_counts_of_check_are_whole_numbers() {
    let folder = Folder::empty("counts");
    let prediction = json(&folder, &["check", "circle", "--json"]);
    for count in ["nodes", "most_nodes", "unknowns", "memory_bytes", "file_bytes", "steps"] {
        assert!(prediction[count].is_u64(), "{count}: {}", prediction[count]);
    }
}

/// The mass of a density with both signs is zero but for rounding.
#[test]
fn the_drift_of_a_mass_is_relative_to_what_there_is() {
    let folder = Folder::empty("drift");
    let density = "[[density]]\nname = 'c'\ninitial = 'cos(2*pi*s)'\nmobility = 'diffusion'\n\
                   [energy.local]\nexpression = '0.5*c^2'\n";
    fs::write(
        folder.0.join("signs.toml"),
        format!("{CIRCLE}{density}").replace("energy = {", "energy.length.tension = 1.0 #"),
    )
    .unwrap();
    let run = json(&folder, &["run", "signs.toml", "--json"]);
    assert!(run["mass_drift_c"].as_f64().unwrap().abs() < 1e-12, "{run}");
}
