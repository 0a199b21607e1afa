//! A result file makes its result again.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::process::Output;

use flow_core::output::hdf5_file;
use flow_core::run::{Record, Seconds};

use folder::Folder;

#[track_caller]
fn succeeds(output: &Output) -> String {
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{talk}");
    talk
}

/// The record without the seconds that it took.
fn timeless(mut record: Record) -> Record {
    record.counters.integration_seconds = 0.0;
    record.seconds = Seconds::default();
    record
}

#[test]
fn the_same_scene_with_the_same_changes_gives_the_same_record() {
    let folder = Folder::empty("from");
    let changes =
        ["--set", "accuracy.nodes=128", "--set", "time.end=0.02", "--set", "title='As \"changed\"'"];
    succeeds(&folder.call(&[&["run", "three_fold", "-o", "first.h5"][..], &changes].concat()));
    let talk = succeeds(&folder.call(&["run", "--from", "first.h5", "-o", "second.h5", "-q"]));
    assert_eq!(talk, "");
    let (first, second) = (folder.record("first.h5"), folder.record("second.h5"));
    assert!(first.scene.contains("128") && first.title.contains("changed"));
    assert_eq!(timeless(first), timeless(second));
    succeeds(&folder.call(&[
        "run",
        "--from",
        "first.h5",
        "-o",
        "third.h5",
        "-q",
        "--set",
        "accuracy.nodes=96",
    ]));
    assert_eq!(folder.record("third.h5").nodes(), 96);
}

#[test]
fn points_of_another_file_are_not_needed_again() {
    let folder = Folder::empty("from-points");
    let points: Vec<String> = (0..40)
        .map(|i| std::f64::consts::TAU * f64::from(i) / 40.0)
        .map(|phi| format!("{:?} {:?}", 1.5 * phi.cos(), phi.sin()))
        .collect();
    fs::write(folder.0.join("points.txt"), points.join("\n")).unwrap();
    let scene =
        "curve = { shape = 'points', file = 'points.txt' }\nenergy.bending.rigidity = 1.0\ntime.end = 0.01\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    succeeds(&folder.call(&["run", "scene.toml", "-o", "first.h5"]));
    fs::remove_file(folder.0.join("points.txt")).unwrap();
    succeeds(&folder.call(&["run", "--from", "first.h5", "-o", "second.h5"]));
    let (first, second) = (folder.record("first.h5"), folder.record("second.h5"));
    assert_eq!((first.frames, first.steps), (second.frames, second.steps));
}

#[test]
fn what_it_takes_is_said() {
    let folder = Folder::empty("from-usage");
    let fails = |args: &[&str]| {
        let output = folder.call(args);
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, talk) = fails(&["run"]);
    assert_eq!(code, Some(2), "{talk}");
    let (code, talk) = fails(&["run", "three_fold", "--from", "first.h5"]);
    assert!(code == Some(2) && talk.contains("cannot be used with"), "{talk}");
    let (code, talk) = fails(&["run", "--from", "none.h5"]);
    assert!(code == Some(5) && talk.contains("none.h5"), "{talk}");
}

#[test]
fn another_program_is_named() {
    let folder = Folder::empty("from-another");
    succeeds(&folder.call(&["run", "circle", "-o", "first.h5", "-q", "--set", "accuracy.tolerance=1e-3"]));
    let mut record = folder.record("first.h5");
    record.provenance.version = "0.0.9".to_owned();
    hdf5_file::write(&record, &folder.0.join("old.h5"), false).unwrap();
    let talk = succeeds(&folder.call(&["run", "--from", "old.h5", "-o", "new.h5", "-q"]));
    assert!(talk.contains("the result was made by Curveflow 0.0.9"), "{talk}");
    let info = folder.call(&["info", "old.h5", "--json"]);
    assert!(String::from_utf8_lossy(&info.stdout).contains("\"curveflow_version\": \"0.0.9\""));
}

#[test]
fn a_run_with_terms_from_outside_its_scene_is_not_made_without_them() {
    let folder = Folder::empty("from-own");
    succeeds(&folder.call(&["run", "circle", "-o", "first.h5", "-q", "--set", "accuracy.tolerance=1e-3"]));
    let mut record = folder.record("first.h5");
    record.own_terms = vec!["bending".to_owned()];
    hdf5_file::write(&record, &folder.0.join("first.h5"), true).unwrap();
    fs::write(folder.0.join("scene.toml"), &record.scene).unwrap();
    for args in [
        &["run", "--from", "first.h5", "-o", "second.h5"][..],
        &["check", "--from", "first.h5"],
        &["run", "scene.toml", "-o", "first.h5", "--resume"],
    ] {
        let output = folder.call(args);
        let talk = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(7) && talk.contains("(`bending`)"), "{args:?}: {talk}");
    }
    let info = folder.call(&["info", "first.h5", "--json"]);
    assert!(String::from_utf8_lossy(&info.stdout).contains("\"own_terms\""));
}
