//! What stops a run from outside: signals and `--max-wall`.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(unix)]

mod folder;

use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use folder::{Folder, code, said, wait_for};

fn send(child: &Child, signal: &str) {
    let signal = format!("-{signal}");
    assert!(Command::new("kill").args([&signal, &child.id().to_string()]).status().unwrap().success());
}

/// As `timeout` and batch systems stop what they have started.
#[test]
fn two_sigterms_in_a_row_keep_what_was_computed() {
    let folder = Folder::new("terms");
    let mut child = folder.long("out.h5").args(["--checkpoint", "0"]).spawn().unwrap();
    wait_for(&folder.0.join("out.h5.checkpoint-a"));
    for _ in 0..2 {
        send(&child, "TERM");
        sleep(Duration::from_millis(1));
    }
    assert_eq!(child.wait().unwrap().code(), Some(6));
    assert!(folder.record("out.h5").counters.steps > 0);
    assert!(!folder.names().contains(&"out.h5.lock".to_owned()));
}

/// The terminal goes, the processor time is used up, a batch system says that the end is near.
#[test]
fn whatever_ends_a_job_keeps_what_was_computed() {
    for signal in ["HUP", "XCPU", "USR1", "USR2"] {
        let folder = Folder::new(signal);
        let mut child = folder.long("out.h5").spawn().unwrap();
        wait_for(&folder.0.join("out.h5.lock"));
        send(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(6), "{signal}");
        assert_eq!(folder.names(), ["out.h5", "out.h5.checkpoint-a", "scene.toml"]);
    }
}

/// As `nohup` starts it.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_to_be_ignored_is() {
    let folder = Folder::new("nohup");
    let long = folder.long("out.h5");
    let mut child = Command::new("sh");
    child.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]).arg(long.get_program()).args(long.get_args());
    let mut child = child.current_dir(&folder.0).stderr(Stdio::null()).spawn().unwrap();
    wait_for(&folder.0.join("out.h5.lock"));
    send(&child, "HUP");
    sleep(Duration::from_millis(500));
    assert!(child.try_wait().unwrap().is_none());
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(6));
}

#[test]
fn the_limit_counts_from_the_start_of_the_command() {
    let folder = Folder::new("outset");
    let late = folder.shell("(sleep 0.5; cat scene.toml) | \"$0\" run /dev/stdin -o out.h5 --max-wall 0.4");
    assert_eq!(code(&late), 6, "{}", said(&late));
    assert_eq!(folder.record("out.h5").counters.steps, 1);
}

#[test]
fn a_limit_beyond_all_clocks_is_none() {
    let folder = Folder::new("beyond");
    for limit in ["9.3e18", "1.8e19"] {
        let run = ["run", "circle", "-o", "run.h5", "--replace", "--max-wall"];
        let done = folder.call(&[&run[..], &[limit]].concat());
        assert_eq!(code(&done), 0, "{}", said(&done));
    }
}
