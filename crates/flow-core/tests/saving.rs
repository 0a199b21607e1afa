//! A run goes on where a checkpoint cannot be written, and what it comes to can be saved until its result is safe.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use flow_core::output::StorageError;
use flow_core::output::checkpoint::{Pair, Saving, read, run_saving};
use flow_core::run::{Observer, Progress, Quiet, Record, Scene, Simulation, StopReason, run};

use folder::Folder;

impl Folder {
    fn result(&self) -> PathBuf {
        self.file("out.h5")
    }

    fn checkpoint(&self, letter: &str) -> PathBuf {
        self.file(&format!("out.h5.checkpoint-{letter}"))
    }
}

/// Its nodes change on the way, so that its frames have other nodes in the record than while it runs.
fn scene() -> Scene {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").unwrap();
    let changes = [("accuracy.nodes", "auto"), ("accuracy.tolerance", "1e-3"), ("time.end", "0.05")];
    let changes = changes.map(|(key, value)| (key.to_owned(), value.to_owned()));
    Scene::parse_with(text, "three_fold", &changes).unwrap()
}

fn assert_same(one: &Record, other: &Record) {
    assert_eq!(one.steps, other.steps);
    assert!(one.frames == other.frames);
    assert_eq!(one.stop_reason, other.stop_reason);
}

fn protect(path: &Path, protected: bool) {
    let mut permissions = fs::metadata(path).unwrap().permissions();
    permissions.set_readonly(protected);
    fs::set_permissions(path, permissions).unwrap();
}

/// A run of two steps with a checkpoint after each, the older of which cannot be replaced.
fn two_steps(folder: &Folder) -> (Simulation, Pair) {
    let (mut simulation, mut pair) = (Simulation::new(&scene()).unwrap(), Pair::beside(&folder.result()));
    for _ in 0..2 {
        simulation.step(&mut Quiet);
        pair.write(&simulation).unwrap();
    }
    protect(&folder.checkpoint("a"), true);
    (simulation, pair)
}

#[test]
fn a_checkpoint_that_fails_does_not_end_the_run() {
    let folder = Folder::new("fails");
    let (simulation, pair) = two_steps(&folder);
    let mut missed = Vec::new();
    let mut when_missed = |error| {
        assert_eq!(read(&folder.checkpoint("b")).unwrap().memory.steps(), 2, "the newer one stays");
        missed.push(error);
        protect(&folder.checkpoint("a"), false);
    };
    let mut saving = Saving { pair, interval: Duration::ZERO, missed: &mut when_missed };
    let ended = run_saving(simulation, &mut Quiet, &mut saving);
    assert!(matches!(ended.last, Some(Ok(()))));
    let last = saving.pair.newest().unwrap().unwrap().checkpoint.memory;
    assert_eq!(last.steps(), ended.record.counters.steps, "the last one is of the end");
    assert_same(&ended.record, &run(&scene(), &mut Quiet).unwrap());
    assert!(matches!(missed[..], [StorageError::Protected { .. }]));
}

/// Stops a run after its next step.
struct Stop;

impl Observer for Stop {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn the_last_checkpoint_of_a_stopped_run_that_fails_is_told() {
    let folder = Folder::new("last");
    let (simulation, pair) = two_steps(&folder);
    let mut saving = Saving { pair, interval: Duration::ZERO, missed: &mut |_| {} };
    let ended = run_saving(simulation, &mut Stop, &mut saving);
    assert_eq!(ended.record.stop_reason, StopReason::Interrupted);
    assert!(matches!(ended.last, Some(Err(StorageError::Protected { .. }))));
    assert_eq!(saving.pair.newest().unwrap().unwrap().checkpoint.memory.steps(), 2);
}

/// A run too short for checkpoints; what it came to is saved all the same if its result cannot be written.
#[test]
fn a_run_that_is_over_can_be_saved() {
    let folder = Folder::new("over");
    let interval = Duration::from_secs(3600);
    let mut saving = Saving { pair: Pair::beside(&folder.result()), interval, missed: &mut |_| {} };
    let ended = run_saving(Simulation::new(&scene()).unwrap(), &mut Quiet, &mut saving);
    assert!(ended.last.is_none() && saving.pair.newest().unwrap().is_none());
    ended.save(&mut saving.pair).unwrap();
    let found = saving.pair.newest().unwrap().unwrap();
    let again = run_saving(found.checkpoint.simulation(&found.path).unwrap(), &mut Quiet, &mut saving);
    assert_eq!(again.record.stop_reason, StopReason::EndTime);
    assert_same(&again.record, &ended.record);
}
