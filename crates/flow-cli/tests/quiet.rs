//! What the commands say when asked to be quiet.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const CIRCLE: &str = "
curve = { shape = 'circle', radius = 1.0 }
energy.bending.rigidity = 1.0
time = { end = 0.1, stop_at_equilibrium = false }
accuracy = { tolerance = 1e-3, nodes = 32 }
output.frames = 2
";

/// A folder with a scene and its result, removed at the end of the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("curveflow-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        fs::write(path.join("circle.toml"), CIRCLE).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn curveflow(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_curveflow")).args(args).current_dir(folder).output().unwrap()
}

#[track_caller]
fn assert_says(output: &Output, data: &str) {
    let talk = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && talk.is_empty(), "{}: {talk}", output.status);
    assert_eq!(String::from_utf8_lossy(&output.stdout), data);
}

#[test]
fn quiet_commands_do_their_work_and_say_nothing() {
    let folder = Folder::new("quiet");
    assert_says(&curveflow(&folder.0, &["run", "circle.toml", "-q"]), "");
    assert_says(&curveflow(&folder.0, &["plot", "circle.h5", "-q"]), "");
    assert!(fs::read(folder.0.join("circle.png")).unwrap().starts_with(b"\x89PNG"));
    assert_says(&curveflow(&folder.0, &["plot", "circle.h5", "--replace"]), "circle.png\n");
}

#[test]
fn a_quiet_command_says_what_went_wrong() {
    let folder = Folder::new("quiet-failure");
    let output = curveflow(&folder.0, &["plot", "circle.h5", "-q"]);
    assert_eq!(output.status.code(), Some(5));
    assert!(String::from_utf8_lossy(&output.stderr).contains("circle.h5"));
}

#[test]
fn a_run_whose_nodes_do_not_resolve_it_says_so() {
    let folder = Folder::new("coarse");
    let said = |args: &[&str]| {
        let output = curveflow(&folder.0, &[&["run", "-o", "run.h5", "--replace"], args].concat());
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
