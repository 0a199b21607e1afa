//! What the commands say when asked to be quiet.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::process::Output;

use folder::Folder;

const CIRCLE: &str = "
curve = { shape = 'circle', radius = 1.0 }
energy.bending.rigidity = 1.0
time = { end = 0.1, stop_at_equilibrium = false }
accuracy = { tolerance = 1e-3, nodes = 32 }
output.frames = 2
";

/// A folder with a scene.
fn folder(name: &str) -> Folder {
    let folder = Folder::empty(name);
    fs::write(folder.0.join("circle.toml"), CIRCLE).unwrap();
    folder
}

#[track_caller]
fn assert_says(output: &Output, data: &str) {
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && talk.is_empty(), "{}: {talk}", output.status);
    assert_eq!(String::from_utf8_lossy(&output.stdout), data);
}

#[test]
fn quiet_commands_do_their_work_and_say_nothing() {
    let folder = folder("quiet");
    assert_says(&folder.call(&["run", "circle.toml", "-q"]), "");
    assert_says(&folder.call(&["plot", "circle.h5", "-q"]), "");
    assert!(fs::read(folder.0.join("circle.png")).unwrap().starts_with(b"\x89PNG"));
    assert_says(&folder.call(&["plot", "circle.h5", "--replace"]), "circle.png\n");
}

#[test]
fn a_quiet_command_says_what_went_wrong() {
    let folder = folder("quiet-failure");
    let output = folder.call(&["plot", "circle.h5", "-q"]);
    assert_eq!(output.status.code(), Some(5));
    assert!(String::from_utf8_lossy(&output.stderr).contains("circle.h5"));
}

#[test]
fn a_run_whose_nodes_do_not_resolve_it_says_so() {
    let folder = folder("coarse");
    let said = |args: &[&str]| {
        let output = folder.call(&[&["run", "-o", "run.h5", "--replace"], args].concat());
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let coarse = ["three_fold", "--set", "accuracy.nodes=128", "--set", "time.end=0.1"];
    assert!(said(&coarse).contains("were not resolved by their nodes"), "{}", said(&coarse));
    assert_eq!(said(&[&coarse[..], &["-q"]].concat()), "");
    assert!(!said(&["circle.toml"]).contains("warning"));
    assert!(
        !said(&["three_fold", "--set", "accuracy.nodes=256", "--set", "time.end=0.1"]).contains("warning")
    );
}
