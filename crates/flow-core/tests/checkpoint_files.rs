//! The two files of a run that is saved on the way take turns, in one process and over several.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;

use std::fs;
use std::ops::ControlFlow;
use std::time::Duration;

use flow_core::output::checkpoint::{Pair, Saving, read, run_saving};
use flow_core::run::{Observer, Progress, Quiet, Scene, Simulation, Spending};

use folder::Folder;

impl Folder {
    fn pair(&self) -> Pair {
        Pair::beside(&self.file("out.h5"))
    }

    /// Steps of the checkpoints that are there, in increasing order.
    fn steps(&self) -> Vec<u64> {
        let files = fs::read_dir(self.path()).unwrap().map(|entry| entry.unwrap().path());
        let mut steps: Vec<u64> = files.map(|path| read(&path).unwrap().memory.steps()).collect();
        steps.sort_unstable();
        steps
    }
}

fn circle() -> Simulation {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
    Simulation::new(&Scene::parse(text, "circle").unwrap()).unwrap()
}

#[test]
fn a_new_checkpoint_never_takes_the_place_of_the_newest() {
    let (folder, mut simulation) = (Folder::new("turns"), circle());
    let mut newest = None;
    for process in 0..4 {
        let mut pair = folder.pair();
        let found = pair.newest().unwrap().map(|found| found.checkpoint.memory.steps());
        assert_eq!(found, newest, "process {process}");
        for _ in 0..=process {
            simulation.step(&mut Quiet);
            pair.write(&simulation).unwrap();
            let steps = simulation.counters().steps;
            assert_eq!(
                folder.steps(),
                newest.into_iter().chain([steps]).collect::<Vec<_>>(),
                "process {process}"
            );
            newest = Some(steps);
        }
    }
}

struct After(u64);

impl Observer for After {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        if progress.steps == self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_run_that_is_saved_on_the_way_says_that_it_took_time_and_keeps_its_last_step() {
    let folder = Folder::new("saved");
    let mut saving = Saving { pair: folder.pair(), interval: Duration::MAX, missed: &mut |_| {} };
    let record = run_saving(circle(), &mut After(7), &mut saving).record;
    assert_eq!((record.counters.steps, folder.steps()), (7, vec![7]));
    assert!(record.seconds[Spending::Output] > 0.0);
}
