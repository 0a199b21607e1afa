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

/// Whether this process ignores the signal; no, where that cannot be told.
fn is_ignored(number: u32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
}

/// The terminal goes, the processor time is used up, a batch system says that the end is near.
#[test]
fn whatever_ends_a_job_keeps_what_was_computed() {
    // Under `nohup` the tests themselves hand an ignored signal on.
    let signals = [("HUP", 1), ("XCPU", 24), ("USR1", 10), ("USR2", 12)];
    for (signal, _) in signals.into_iter().filter(|(_, number)| !is_ignored(*number)) {
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

/// Something else came to the name of the result while the run was stopped.
#[test]
fn going_on_spares_what_is_no_result() {
    let folder = Folder::new("spared");
    let mut child = folder.long("out.h5").spawn().unwrap();
    wait_for(&folder.0.join("out.h5.lock"));
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(6));
    let result = folder.0.join("out.h5");
    std::fs::write(&result, "precious").unwrap();
    let resume = || folder.command(&["resume", "out.h5", "--max-wall", "0"]).output().unwrap();
    let refused = resume();
    assert_eq!(code(&refused), 5, "{}", said(&refused));
    assert!(said(&refused).contains("move it away"), "{}", said(&refused));
    assert_eq!(std::fs::read_to_string(&result).unwrap(), "precious");
    std::fs::remove_file(&result).unwrap();
    assert_eq!(code(&resume()), 6);
}
