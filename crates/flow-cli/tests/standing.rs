//! What a command makes of results and checkpoints that lie beside each other.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::process::Stdio;

use flow_core::output::hdf5_file;

use folder::{Folder, code, said, wait_for};

const STOP: [&str; 2] = ["--max-wall", "0"];

fn run(folder: &Folder, name: &str, more: &[&str]) -> i32 {
    code(&folder.call(&[&["run", "scene.toml", "-q", "-o", name], more].concat()))
}

/// Whatever has come to the place of its result is not what the run was to replace.
#[test]
fn going_on_spares_results_of_other_scenes() {
    let folder = Folder::new("spares");
    assert_eq!(code(&folder.call(&["run", "circle", "-q", "-o", "circle.h5"])), 0);
    assert_eq!(run(&folder, "out.h5", &STOP), 6);
    let own = fs::read(folder.0.join("out.h5")).unwrap();
    fs::copy(folder.0.join("circle.h5"), folder.0.join("out.h5")).unwrap();
    let circle = folder.record("circle.h5");
    for command in [&["resume", "out.h5"][..], &["run", "scene.toml", "-o", "out.h5", "--resume"]] {
        let refused = folder.call(command);
        assert_eq!(code(&refused), 5, "{}", said(&refused));
        assert!(said(&refused).contains("move it away"), "{}", said(&refused));
        assert_eq!(folder.record("out.h5"), circle);
    }
    fs::write(folder.0.join("out.h5"), own).unwrap();
    assert_eq!(code(&folder.call(&["resume", "out.h5"])), 0);
}

/// That was asked for when the run began.
#[test]
fn what_a_run_was_to_replace_it_replaces_when_it_goes_on() {
    let folder = Folder::new("replaces");
    assert_eq!(code(&folder.call(&["run", "circle", "-q", "-o", "out.h5"])), 0);
    let circle = fs::read(folder.0.join("out.h5")).unwrap();
    assert_eq!(run(&folder, "out.h5", &[&STOP[..], &["--replace"]].concat()), 6);
    // As after a kill: the result is the old one still.
    fs::write(folder.0.join("out.h5"), &circle).unwrap();
    let seen = folder.call(&["info", "out.h5"]);
    assert!(said(&seen).contains("a run that is to replace out.h5 is not over"), "{}", said(&seen));
    assert_eq!(code(&folder.call(&["resume", "out.h5", "--max-wall", "0"])), 6);
    fs::write(folder.0.join("out.h5"), &circle).unwrap();
    let resumed = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&resumed), 0, "{}", said(&resumed));
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
}

/// Before its first checkpoint a run has left nothing but its lock.
#[test]
fn a_run_that_has_just_begun_is_told() {
    let folder = Folder::new("begun");
    assert_eq!(code(&folder.call(&["run", "circle", "-q", "-o", "old.h5"])), 0);
    let told = |name: &str| said(&folder.call(&["info", name]));
    assert!(!told("old.h5").contains("goes on"), "{}", told("old.h5"));
    for (name, replace) in [("old.h5", true), ("out.h5", false)] {
        let mut run = folder.long(name);
        let mut run = if replace { run.arg("--replace") } else { &mut run }.spawn().unwrap();
        wait_for(&folder.0.join(format!("{name}.lock")));
        std::thread::sleep(std::time::Duration::from_millis(50));
        let seen = told(name);
        run.kill().unwrap();
        run.wait().unwrap();
        assert!(seen.contains(&format!("a run to {name} goes on, which has written nothing yet")), "{seen}");
        assert_eq!(seen.contains("this is the result that is there"), replace, "{seen}");
        assert!(!told(name).contains("goes on"), "{}", told(name));
    }
}

/// A run that goes on is shown by where it was stopped until it has come further.
#[test]
fn a_run_that_has_just_gone_on_is_shown_by_where_it_was_stopped() {
    let folder = Folder::new("gone_on");
    let stopped = folder.long("out.h5").args(["--max-wall", "0.2"]).output().unwrap();
    assert_eq!(code(&stopped), 6, "{}", said(&stopped));
    let steps = format!("\"steps\": {},", folder.record("out.h5").counters.steps);
    for has_result in [true, false] {
        if !has_result {
            fs::remove_file(folder.0.join("out.h5")).unwrap(); // as after a kill
        }
        let mut run = folder.long("out.h5").arg("--resume").spawn().unwrap();
        wait_for(&folder.0.join("out.h5.lock"));
        std::thread::sleep(std::time::Duration::from_millis(50));
        let seen = folder.call(&["info", "out.h5", "--json"]);
        run.kill().unwrap();
        run.wait().unwrap();
        let note = if has_result {
            "goes on, which has written nothing since it began"
        } else {
            "newest checkpoint"
        };
        assert!(said(&seen).contains(note), "{}", said(&seen));
        assert!(String::from_utf8_lossy(&seen.stdout).contains(&steps), "{steps}");
    }
}

/// Killed after it was stopped and had gone on.
#[test]
fn a_run_is_shown_as_far_as_it_has_come() {
    let folder = Folder::new("further");
    assert_eq!(run(&folder, "out.h5", &STOP), 6);
    let first = fs::read(folder.0.join("out.h5")).unwrap();
    let seen = folder.call(&["info", "out.h5"]);
    assert_eq!(said(&seen), "");
    assert_eq!(code(&folder.call(&["resume", "out.h5", "--max-wall", "0"])), 6);
    let further = folder.record("out.h5");
    fs::write(folder.0.join("out.h5"), first).unwrap();
    let seen = folder.call(&["info", "out.h5", "--json"]);
    assert!(said(&seen).contains("this is its newest checkpoint"), "{}", said(&seen));
    let steps = format!("\"steps\": {},", further.counters.steps);
    assert!(String::from_utf8_lossy(&seen.stdout).contains(&steps));
}

/// The result of another process appears during the run.
#[test]
fn a_result_that_has_come_meanwhile_is_to_be_moved_away() {
    let folder = Folder::new("meanwhile");
    assert_eq!(code(&folder.call(&["run", "circle", "-q", "-o", "circle.h5"])), 0);
    let mut long = folder.long("out.h5");
    let long = long.args(["--checkpoint", "0", "--max-wall", "1"]).stderr(Stdio::piped()).spawn().unwrap();
    wait_for(&folder.0.join("out.h5.checkpoint-a"));
    fs::copy(folder.0.join("circle.h5"), folder.0.join("out.h5")).unwrap();
    let late = long.wait_with_output().unwrap();
    assert_eq!(code(&late), 5, "{}", said(&late));
    assert!(said(&late).contains("move it away, then go on with `resume`"), "{}", said(&late));
    let resume = ["resume", "out.h5", "--max-wall", "0"];
    assert_eq!(code(&folder.call(&resume)), 5);
    fs::remove_file(folder.0.join("out.h5")).unwrap();
    assert_eq!(code(&folder.call(&resume)), 6);
}

#[test]
fn a_damaged_checkpoint_says_how_to_start_anew() {
    let folder = Folder::new("anew");
    assert_eq!(run(&folder, "out.h5", &STOP), 6);
    fs::remove_file(folder.0.join("out.h5")).unwrap();
    let checkpoint = folder.0.join("out.h5.checkpoint-a");
    let whole = fs::read(&checkpoint).unwrap();
    for bytes in [&whole[..whole.len() / 2], b"text"] {
        fs::write(&checkpoint, bytes).unwrap();
        for more in [&[][..], &["--resume"]] {
            let refused = folder.call(&[&["run", "scene.toml", "-o", "out.h5"], more].concat());
            assert_eq!(code(&refused), 7);
            assert!(said(&refused).contains("run --replace"), "{}", said(&refused));
        }
    }
    assert_eq!(run(&folder, "out.h5", &["--replace"]), 0);
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
}

/// The last checkpoint is refused as the result is, and one from before is there.
#[cfg(target_os = "linux")]
#[test]
fn a_run_is_not_lost_as_long_as_it_has_an_older_checkpoint() {
    let folder = Folder::new("older");
    assert_eq!(run(&folder, "whole.h5", &[]), 0);
    // Enough for checkpoints on the way, and not for the last one, nor for the result.
    let sizes = "ulimit -f 500; exec \"$0\" run scene.toml -o out.h5 --checkpoint 0";
    let unwritten = folder.shell(sizes);
    assert_eq!(code(&unwritten), 5, "{}", said(&unwritten));
    assert!(said(&unwritten).contains("the run is not lost"), "{}", said(&unwritten));
    assert_eq!(code(&folder.call(&["resume", "out.h5"])), 0);
    let (whole, resumed) = (folder.record("whole.h5"), folder.record("out.h5"));
    assert!(whole.frames == resumed.frames && whole.steps == resumed.steps);
}

/// One process replaces a result by others of another size, and one reads it.
#[test]
fn a_result_that_is_replaced_meanwhile_is_whole() {
    let folder = Folder::new("whole");
    let scenes = ["output.frames=2", "output.frames=40"];
    let names = ["small.h5", "large.h5"];
    for (name, frames) in names.iter().zip(scenes) {
        assert_eq!(code(&folder.call(&["run", "circle", "-q", "-o", name, "--set", frames])), 0);
    }
    let [small, large] = names.map(|name| folder.record(name));
    let path = folder.0.join("out.h5");
    hdf5_file::write(&small, &path, false).unwrap();
    std::thread::scope(|scope| {
        let writer = scope.spawn(|| {
            for k in 0..600 {
                hdf5_file::write(if k % 2 == 0 { &large } else { &small }, &path, true).unwrap();
            }
        });
        while !writer.is_finished() {
            let read = hdf5_file::read(&path).unwrap();
            assert!(read == small || read == large);
        }
    });
}

#[test]
fn results_without_a_name_are_named_after_the_whole_of_their_scene() {
    let folder = Folder::new("named");
    for name in ["eps_0.1.toml", "eps_0.2.toml", "my.scene.toml"] {
        fs::copy(folder.0.join("scene.toml"), folder.0.join(name)).unwrap();
        assert_eq!(code(&folder.call(&["run", name, "-q", "--max-wall", "0"])), 6, "{name}");
        assert!(folder.0.join(name.replace(".toml", ".h5")).exists());
    }
    fs::copy(folder.0.join("eps_0.1.h5"), folder.0.join("bare_0.5")).unwrap();
    assert_eq!(code(&folder.call(&["plot", "bare_0.5", "-q"])), 0);
    assert_eq!(code(&folder.call(&["view", "my.scene.h5", "-q"])), 0);
    assert!(folder.names().contains(&"bare_0.5.png".to_owned()), "{:?}", folder.names());
    assert!(folder.names().contains(&"my.scene.html".to_owned()), "{:?}", folder.names());
}
