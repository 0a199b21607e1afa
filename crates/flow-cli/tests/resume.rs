//! Runs of the command that are stopped or killed, and go on.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use flow_core::run::Record;

use folder::{Folder, code, said, wait_for};

fn assert_same(one: &Record, other: &Record) {
    assert_eq!(one.steps, other.steps);
    assert!(one.frames == other.frames);
    assert_eq!(one.stop_reason, other.stop_reason);
    assert_eq!((&one.scene, &one.resolved_scene), (&other.scene, &other.resolved_scene));
}

#[test]
fn a_killed_run_goes_on_to_the_same_file() {
    let folder = Folder::new("killed");
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "whole.h5", "-q"])), 0);
    let whole = folder.record("whole.h5");
    let arguments = ["run", "scene.toml", "-o", "cut.h5", "-q", "--resume", "--checkpoint", "0"];
    for name in [".cut.h5-1-0.partial", ".cut.h5.checkpoint-b-1-0.partial"] {
        fs::write(folder.0.join(name), b"half of it").unwrap();
    }
    let mut kills = 0;
    for attempt in 0.. {
        let mut child = folder.command(&arguments).stderr(Stdio::piped()).spawn().unwrap();
        sleep(Duration::from_millis(15 + 4 * attempt));
        let done = child.try_wait().unwrap().is_some();
        child.kill().unwrap();
        let output = child.wait_with_output().unwrap();
        if done {
            assert_eq!(code(&output), 0, "{}", said(&output));
            break;
        }
        kills += 1;
        assert!(attempt < 200, "no progress");
    }
    assert_same(&whole, &folder.record("cut.h5"));
    // What a killed process leaves half written is removed by the next one.
    assert_eq!(folder.names(), ["cut.h5", "scene.toml", "whole.h5"]);
    println!("{kills} kills");
}

#[test]
fn a_run_stopped_by_its_limit_goes_on_by_the_same_command() {
    let folder = Folder::new("limit");
    let arguments = ["run", "scene.toml", "-o", "out.h5", "--resume"];
    let stopped = folder.call(&[&arguments[..], &["--max-wall", "0"]].concat());
    assert_eq!(code(&stopped), 6, "{}", said(&stopped));
    assert!(said(&stopped).contains("curveflow resume out.h5"), "{}", said(&stopped));
    assert_eq!(folder.names(), ["out.h5", "out.h5.checkpoint-a", "scene.toml"]);

    let other = folder.call(&[&arguments[..], &["--set", "time.end=50.0"]].concat());
    assert_eq!(code(&other), 7);
    assert!(said(&other).contains("another scene"), "{}", said(&other));

    let anew = folder.call(&["run", "scene.toml", "-o", "out.h5"]);
    assert_eq!(code(&anew), 5, "{}", said(&anew));

    let done = folder.call(&arguments);
    assert_eq!(code(&done), 0, "{}", said(&done));
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
    let again = folder.call(&arguments);
    assert_eq!(code(&again), 0);
    assert!(said(&again).contains("nothing to do"), "{}", said(&again));
}

#[test]
fn a_stopped_run_is_not_thrown_away_unasked() {
    let folder = Folder::new("unasked");
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "out.h5", "--max-wall", "0"])), 6);
    fs::remove_file(folder.0.join("out.h5")).unwrap();
    let anew = folder.call(&["run", "scene.toml", "-o", "out.h5"]);
    assert_eq!(code(&anew), 5);
    assert!(said(&anew).contains("stopped before its end"), "{}", said(&anew));
    let replaced = folder.call(&["run", "scene.toml", "-o", "out.h5", "--replace"]);
    assert_eq!(code(&replaced), 0, "{}", said(&replaced));
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
}

#[test]
fn without_a_whole_checkpoint_nothing_goes_on() {
    let folder = Folder::new("damaged");
    assert_eq!(code(&folder.call(&["resume", "out.h5"])), 7);
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "out.h5", "--max-wall", "0"])), 6);
    let checkpoint = folder.0.join("out.h5.checkpoint-a");
    let mut bytes = fs::read(&checkpoint).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&checkpoint, &bytes).unwrap();
    let damaged = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&damaged), 7);
    assert!(said(&damaged).contains("damaged"), "{}", said(&damaged));
    fs::remove_file(&checkpoint).unwrap();
    let missing = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&missing), 7);
    assert!(said(&missing).contains("no checkpoint"), "{}", said(&missing));
}

#[test]
fn of_two_runs_to_one_file_the_second_is_refused() {
    let folder = Folder::new("two");
    let mut first = folder.long("out.h5").spawn().unwrap();
    wait_for(&folder.0.join("out.h5.lock"));
    sleep(Duration::from_millis(50));
    let second = folder.call(&["run", "scene.toml", "-o", "out.h5", "-q"]);
    first.kill().unwrap();
    first.wait().unwrap();
    assert_eq!(code(&second), 5, "{}", said(&second));
    assert!(said(&second).contains("another run writes"), "{}", said(&second));
    // The lock of a killed process is free.
    let third = folder.call(&["run", "scene.toml", "-o", "out.h5", "-q", "--max-wall", "0"]);
    assert_eq!(code(&third), 6, "{}", said(&third));
}

/// A lock cannot be made in a folder that may only be read; here something else has its name.
#[test]
fn a_run_that_is_done_needs_no_lock() {
    let folder = Folder::new("lockless");
    assert_eq!(code(&folder.call(&["run", "circle", "-o", "run.h5", "-q"])), 0);
    fs::create_dir(folder.0.join("run.h5.lock")).unwrap();
    let done = folder.call(&["resume", "run.h5"]);
    assert_eq!(code(&done), 0, "{}", said(&done));
    assert!(said(&done).contains("nothing to do"), "{}", said(&done));
    let done = folder.call(&["run", "circle", "-o", "run.h5", "--resume"]);
    assert_eq!(code(&done), 0, "{}", said(&done));
    assert!(said(&done).contains("nothing to do"), "{}", said(&done));
}

#[test]
fn a_finished_run_of_another_scene_is_not_taken_for_this_one() {
    let folder = Folder::new("other-done");
    assert_eq!(code(&folder.call(&["run", "circle", "-o", "run.h5", "-q"])), 0);
    assert_eq!(code(&folder.call(&["run", "circle", "-o", "run.h5", "-q", "--resume"])), 0);
    for other in [&["three_fold"][..], &["circle", "--set", "time.end=2"]] {
        let done = folder.call(&[&["run"], other, &["-o", "run.h5", "-q", "--resume"]].concat());
        assert_eq!(code(&done), 7);
        assert!(said(&done).contains("of another scene"), "{}", said(&done));
    }
}

/// What counts is what the run is made of, wherever it stands and however it is written.
#[test]
fn a_scene_is_the_same_as_long_as_it_makes_the_same_run() {
    let folder = Folder::new("same");
    let ellipse = |ratio: f64| {
        let points = (0..64).map(|i| std::f64::consts::TAU * f64::from(i) / 64.0);
        let lines: Vec<String> =
            points.map(|phi| format!("{:?} {:?}", ratio * phi.cos(), phi.sin())).collect();
        fs::write(folder.0.join("points.txt"), lines.join("\n")).unwrap();
    };
    let scene =
        "curve = { shape = 'points', file = 'points.txt' }\nenergy.bending.rigidity = 1.0\ntime.end = 0.01\n";
    fs::write(folder.0.join("scene.toml"), scene).unwrap();
    ellipse(2.0);
    for (stop, name) in [(&["--max-wall", "0"][..], "stopped.h5"), (&[], "done.h5")] {
        let resumed = |more: &[&str]| {
            folder.call(&[&["run", "scene.toml", "-o", name, "--resume", "--max-wall", "0"], more].concat())
        };
        folder.call(&[&["run", "scene.toml", "-o", name], stop].concat());
        ellipse(3.0);
        let other = resumed(&[]);
        assert_eq!(code(&other), 7, "{name}: {}", said(&other));
        assert!(
            said(&other).contains("of another scene, which differs in `curve.points`"),
            "{}",
            said(&other)
        );
        ellipse(2.0);
        fs::write(folder.0.join("scene.toml"), format!("# commented\n{scene}\n")).unwrap();
        for change in [&[][..], &["--set", "time.end=0.01"], &["--set", "accuracy.tolerance=1e-5"]] {
            let same = resumed(change);
            assert!(matches!(code(&same), 0 | 6), "{name}: {}", said(&same));
        }
        fs::write(folder.0.join("scene.toml"), scene).unwrap();
    }
}

#[test]
fn a_run_that_has_used_up_its_steps_goes_on_if_it_may_take_more() {
    let folder = Folder::new("more-steps");
    let run = |name: &str, more: &[&str]| {
        folder.call(&[&["run", "scene.toml", "-o", name, "-q", "--set", "time.end=0.01"], more].concat())
    };
    assert_eq!(code(&run("whole.h5", &[])), 0);
    for last in ["time.max_steps=1000", "time.max_steps="] {
        let used_up = run("out.h5", &["--set", "time.max_steps=5"]);
        assert_eq!(code(&used_up), 4, "{}", said(&used_up));
        assert!(said(&used_up).contains("run --resume"), "{}", said(&used_up));
        // Without more of them it ends as before.
        let before = folder.record("out.h5");
        assert_eq!(code(&folder.call(&["resume", "out.h5", "-q"])), 4);
        assert_same(&before, &folder.record("out.h5"));
        let fewer = run("out.h5", &["--resume", "--set", "time.max_steps=4"]);
        assert_eq!(code(&fewer), 7);
        assert!(said(&fewer).contains("`time.max_steps`"), "{}", said(&fewer));
        let few = run("out.h5", &["--resume", "--set", "time.max_steps=8"]);
        assert_eq!((code(&few), folder.record("out.h5").counters.steps), (4, 8), "{}", said(&few));
        let resumed = ["--resume", "--set", last];
        let rest = run("out.h5", &resumed[..if last.ends_with('=') { 1 } else { 3 }]);
        assert_eq!(code(&rest), 0, "{}", said(&rest));
        let (whole, resumed) = (folder.record("whole.h5"), folder.record("out.h5"));
        assert!(whole.frames == resumed.frames && whole.steps == resumed.steps);
        assert_ne!(resumed.scene.contains("1000"), last.ends_with('='));
        assert_eq!(folder.names(), ["out.h5", "scene.toml", "whole.h5"]);
        fs::remove_file(folder.0.join("out.h5")).unwrap();
    }
}
