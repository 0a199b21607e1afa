//! What there is of a run is kept when something around it goes wrong.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use folder::{Folder, code, said};

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
