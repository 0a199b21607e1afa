//! The command `tradeoff`: what it prints, what it draws, and how it ends.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

#[cfg(unix)]
use std::io::{BufRead, BufReader};
#[cfg(unix)]
use std::process::Stdio;
use std::process::{Command, Output};

use serde_json::Value;

use folder::Folder;

impl Folder {
    fn tradeoff(&self, arguments: &[&str]) -> Output {
        self.call(&[&["tradeoff"], arguments].concat())
    }
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Exit code and standard error of a command that prints nothing.
#[track_caller]
fn refused(output: &Output) -> (i32, String) {
    assert!(output.stdout.is_empty());
    (output.status.code().unwrap(), String::from_utf8(output.stderr.clone()).unwrap())
}

#[test]
fn the_table_goes_to_stdout_and_the_picture_beside_the_scene() {
    let folder = Folder::empty("table");
    let output = folder.tradeoff(&["circle", "--tolerances", "1e-5,1e-2,1e-3", "--error", "2e-5"]);
    assert!(output.status.success(), "{output:?}");
    let (table, talk) = (stdout(&output), String::from_utf8_lossy(&output.stderr).into_owned());
    let first: Vec<&str> = table.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(first, ["asked", "1e-2", "1e-3", "1e-5", "cheapest"]);
    assert!(table.contains("cheapest for 2e-5: accuracy.tolerance = 1e-5 with 32 nodes"), "{table}");
    assert!(talk.contains("run 3 of 3, at tolerance 1e-5") && talk.contains("errors in time only"), "{talk}");
    assert_eq!(folder.names(), ["circle_tradeoff.png"]);
    let (code, error) = refused(&folder.tradeoff(&["circle"]));
    assert!(code == 5 && error.contains("circle_tradeoff.png: already exists"), "{code}: {error}");
}

#[test]
fn json_holds_the_errors_at_both_times() {
    let folder = Folder::empty("json");
    let arguments = ["circle", "--tolerances", "1e-3", "--reference-nodes", "128", "--json", "-q"];
    let output = folder.tradeoff(&[&arguments[..], &["-o", "figure.svg", "--error", "0.1"]].concat());
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    let value: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((&value["reference"]["nodes"], &value["includes_space"]), (&128.into(), &true.into()));
    let row = &value["rows"][0];
    assert_eq!(value["cheapest"], *row);
    let (halfway, end) = (&row["errors"]["halfway"], &row["errors"]["end"]);
    for name in ["curve", "curvature", "energy", "length"] {
        assert!(halfway[name].as_f64().unwrap() > 0.0 && end[name].as_f64().unwrap() > 0.0, "{name}");
    }
    let all = [halfway, end].map(|errors| errors.as_object().unwrap().values());
    let largest = all.into_iter().flatten().map(|error| error.as_f64().unwrap()).fold(0.0, f64::max);
    assert_eq!(row["error"], largest);
    assert_eq!(folder.names(), ["figure.svg"]);
}

#[test]
fn a_figure_is_drawn_unless_nobody_wants_it() {
    let folder = Folder::empty("figure");
    for wanted in ["--json", "--no-picture"] {
        let output = folder.tradeoff(&["circle", "--tolerances", "1e-2", "-q", wanted]);
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        assert!(folder.names().is_empty(), "{:?}", folder.names());
    }
}

/// Automatic nodes may be as many as those of the reference at some tolerances only.
#[test]
fn errors_are_of_space_where_a_run_has_fewer_nodes() {
    let folder = Folder::empty("scope");
    let output = folder.tradeoff(&["blend", "--tolerances", "1e-2,1e-8", "--json"]);
    let value: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let nodes: Vec<_> = value["rows"].as_array().unwrap().iter().map(|row| row["nodes"].as_u64()).collect();
    assert!(
        nodes[0] < value["reference"]["nodes"].as_u64() && nodes[1] == value["reference"]["nodes"].as_u64()
    );
    let of_rows = [0, 1].map(|row| value["rows"][row]["includes_space"].as_bool().unwrap());
    assert_eq!((of_rows, &value["includes_space"]), ([true, false], &false.into()));
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(talk.contains("errors in time and space, but in time only at 1e-8 ("), "{talk}");
}

#[test]
fn a_bad_list_of_tolerances_says_why() {
    let folder = Folder::empty("list");
    for (list, words) in [
        ("1e-3,1e-12", "tolerance 1e-12, number 2 of the list, must be between 1e-10"),
        ("1e-3,0.001", "tolerance 1e-3 is in the list twice"),
        ("1e-3,small", "invalid value 'small' for '--tolerances"),
    ] {
        let (code, error) = refused(&folder.tradeoff(&["circle", "--tolerances", list]));
        assert!(code == 2 && error.contains(words), "{code}: {error}");
    }
    for (arguments, words) in [
        (
            &["--set", "accuracy.nodes=64", "--reference-nodes", "32"][..],
            "the reference has 32 nodes, but a run that it measures 64",
        ),
        (&["--error=-1"], "must be positive"),
        (&["-o", "figure.pdf"], "ends in .png or .svg"),
    ] {
        let (code, error) = refused(&folder.tradeoff(&[&["circle", "-q"], arguments].concat()));
        assert!(code == 2 && error.contains(words), "{code}: {error}");
    }
    assert!(folder.names().is_empty());
}

#[test]
fn scenes_and_runs_that_fail_have_their_exit_codes() {
    let folder = Folder::empty("failures");
    let (code, error) = refused(&folder.tradeoff(&["circle", "--set", "accuracy.tolerance=2"]));
    assert!(code == 3 && error.contains("accuracy.tolerance"), "{code}: {error}");
    let (code, error) = refused(&folder.tradeoff(&["circle", "-q", "--set", "time.max_steps=3"]));
    assert!(code == 4 && error.contains("time.max_steps"), "{code}: {error}");
    let output = folder.tradeoff(&["circle", "-q", "--tolerances", "1e-2", "--error", "1e-9"]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(4));
    assert!(error.contains("no run has an error of 1e-9 or less"), "{error}");
    assert_eq!(stdout(&output).lines().count(), 2);
}

/// What a ladder prints that is stopped in its second run, and the last line that it says.
#[cfg(unix)]
fn interrupted(folder: &Folder, more: &[&str]) -> (Output, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_curveflow"))
        .args(["tradeoff", "three_fold_sharp", "--tolerances", "1e-2,1e-9"])
        .args(more)
        .current_dir(&folder.0)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut talk = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    assert!(talk.any(|line| line.starts_with("run 2 of 2")));
    let interrupted = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupted.success());
    let last = talk.last().unwrap();
    (child.wait_with_output().unwrap(), last)
}

#[cfg(unix)]
#[test]
fn a_signal_keeps_the_runs_that_are_complete() {
    let folder = Folder::empty("signal");
    let (output, last) = interrupted(&folder, &[]);
    assert_eq!(output.status.code(), Some(6), "{last}");
    assert_eq!(last, "error: stopped by a signal after 1 of the runs; try fewer tolerances, or looser ones");
    let table = stdout(&output);
    assert!(table.lines().nth(2).unwrap().contains("interrupted before the run was complete"), "{table}");
    assert_eq!(folder.names(), ["three_fold_sharp_tradeoff.png"]);
}

#[cfg(unix)]
#[test]
fn a_run_without_a_result_has_the_keys_of_the_others() {
    let folder = Folder::empty("ladder-keys");
    let (output, _) = interrupted(&folder, &["--json"]);
    let value: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let keys = |row: usize| value["rows"][row].as_object().unwrap().keys().collect::<Vec<_>>();
    assert_eq!(keys(0), keys(1));
    assert!(value["rows"][0]["failure"].is_null() && value["rows"][1]["failure"].is_string());
    assert!(value["rows"][1]["error"].is_null() && value["cheapest"].is_null());
}
