//! What there is of a run is kept when something around it goes wrong.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use folder::{Folder, code, said, wait_for};

/// Refused only once the initial state is made; the run that is there goes on as if nothing had been asked.
#[test]
fn what_is_refused_replaces_nothing() {
    let folder = Folder::new("refused");
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "out.h5", "--max-wall", "0"])), 6);
    let before = folder.names();
    let replace = ["run", "scene.toml", "-o", "out.h5", "--replace", "--set"];
    for unusable in ["accuracy.nodes=8", "output.frames=100000"] {
        let large = ["--set", "accuracy.nodes=65536"];
        let large = if unusable.starts_with("output") { &large[..] } else { &[] };
        let refused = folder.call(&[&replace[..], &[unusable], large].concat());
        assert_eq!(code(&refused), 3, "{}", said(&refused));
        assert_eq!(folder.names(), before);
    }
    let resumed = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&resumed), 0, "{}", said(&resumed));
}

/// Of the run that is replaced nothing comes back, though it had more steps.
#[test]
fn a_run_that_replaces_another_goes_on_as_itself() {
    let folder = Folder::new("superseded");
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "out.h5", "--max-wall", "0"])), 6);
    assert_eq!(code(&folder.call(&["resume", "out.h5", "--max-wall", "0"])), 6);
    let two = ["out.h5", "out.h5.checkpoint-a", "out.h5.checkpoint-b", "scene.toml"];
    assert_eq!(folder.names(), two);
    let other = ["run", "scene.toml", "-o", "out.h5", "--replace", "--max-wall", "0"];
    assert_eq!(code(&folder.call(&[&other[..], &["--set", "time.end=50.0"]].concat())), 6);
    assert_eq!(folder.names().len(), 3);
    let resumed = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&resumed), 0, "{}", said(&resumed));
    assert!(said(&resumed).contains("after 1 step\n"), "{}", said(&resumed));
    assert!(folder.record("out.h5").scene.contains("50.0"));
}

/// The limit lets the checkpoint through, which is smaller than the result.
#[cfg(target_os = "linux")]
#[test]
fn a_result_that_cannot_be_written_is_written_by_resume() {
    const SMALL: &str =
        "run scene.toml --set accuracy.nodes=64 --set accuracy.tolerance=1e-2 --set output.frames=2";
    let folder = Folder::new("unwritten");
    let limited = format!("ulimit -f 64; exec \"$0\" {SMALL} -o out.h5");
    let unwritten = folder.shell(&limited);
    assert_eq!(code(&unwritten), 5, "{}", said(&unwritten));
    let said_why = said(&unwritten);
    assert!(said_why.contains("ulimit -f") && said_why.contains("curveflow resume out.h5"), "{said_why}");
    assert_eq!(folder.names(), ["out.h5.checkpoint-a", "scene.toml"]);
    let resumed = folder.call(&["resume", "out.h5"]);
    assert_eq!(code(&resumed), 0, "{}", said(&resumed));
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
    assert_eq!(code(&folder.shell(&format!("exec \"$0\" {SMALL} -o whole.h5"))), 0);
    let (resumed, whole) = (folder.record("out.h5"), folder.record("whole.h5"));
    assert!(resumed.frames == whole.frames && resumed.steps == whole.steps);
}

/// The result of a run whose last checkpoint is refused is there all the same.
#[test]
fn a_stopped_run_without_its_checkpoint_leaves_its_result() {
    let folder = Folder::new("uncheckpointed");
    std::fs::create_dir(folder.0.join("out.h5.checkpoint-a")).unwrap();
    let stopped = folder.call(&["run", "scene.toml", "-o", "out.h5", "--replace", "--max-wall", "0"]);
    assert_eq!(code(&stopped), 5, "{}", said(&stopped));
    assert!(said(&stopped).contains("checkpoint-a: is not a plain file"), "{}", said(&stopped));
    assert_eq!(folder.record("out.h5").counters.steps, 1);
}

/// A link is another name of the file that it leads to, also before that file is there.
#[cfg(unix)]
#[test]
fn a_link_to_a_result_is_the_same_result() {
    let folder = Folder::new("linked");
    std::fs::create_dir(folder.0.join("disk")).unwrap();
    std::os::unix::fs::symlink("disk/real.h5", folder.0.join("link.h5")).unwrap();
    let mut first = folder.long("link.h5").spawn().unwrap();
    wait_for(&folder.0.join("disk/real.h5.lock"));
    std::thread::sleep(std::time::Duration::from_millis(50));
    let second = folder.call(&["run", "scene.toml", "-o", "disk/real.h5", "-q"]);
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(said(&second).contains("another run writes"), "{}", said(&second));
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "link.h5", "--max-wall", "0"])), 6);
    assert_eq!(folder.names(), ["disk", "link.h5", "scene.toml"]);
    let resumed = folder.call(&["resume", "disk/real.h5"]);
    assert_eq!(code(&resumed), 0, "{}", said(&resumed));
    assert_eq!(folder.record("link.h5"), folder.record("disk/real.h5"));
}

/// As after `kill -9`, or while the run goes on.
#[test]
fn a_run_without_a_result_yet_can_be_looked_at() {
    let folder = Folder::new("so-far");
    assert_eq!(code(&folder.call(&["run", "scene.toml", "-o", "out.h5", "--max-wall", "0"])), 6);
    std::fs::remove_file(folder.0.join("out.h5")).unwrap();
    let seen = folder.call(&["info", "out.h5"]);
    assert_eq!(code(&seen), 0, "{}", said(&seen));
    assert!(said(&seen).contains("not over") && said(&seen).contains("resume"), "{}", said(&seen));
    assert!(String::from_utf8_lossy(&seen.stdout).contains("interrupted"));
    assert_eq!(code(&folder.call(&["plot", "out.h5", "-o", "out.png"])), 0);
    assert_eq!(folder.names(), ["out.h5.checkpoint-a", "out.png", "scene.toml"], "nothing is touched");
    assert_eq!(code(&folder.call(&["info", "other.h5"])), 5);
}

/// Enough memory for the run, and too little for its result.
#[cfg(target_os = "linux")]
#[test]
fn a_result_that_has_no_memory_is_written_by_resume() {
    let folder = Folder::new("memory");
    let many = "run three_fold_sharp --set output.frames=3000 --set time.end=1 -q -o out.h5 --checkpoint 0.1";
    let unwritten = folder.shell(&format!("ulimit -v 300000; exec \"$0\" {many}"));
    assert_eq!(code(&unwritten), 5, "{}", said(&unwritten));
    assert!(said(&unwritten).contains("in memory failed"), "{}", said(&unwritten));
    let seen = folder.shell("ulimit -v 150000; exec \"$0\" info out.h5");
    assert_eq!(code(&seen), 5, "{}", said(&seen));
    assert!(said(&seen).contains("free some memory"), "{}", said(&seen));
    assert_eq!(code(&folder.call(&["resume", "out.h5", "-q"])), 0);
    assert_eq!(folder.names(), ["out.h5", "scene.toml"]);
}
