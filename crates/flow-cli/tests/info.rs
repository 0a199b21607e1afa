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
