//! A run that is cut and goes on from a checkpoint ends as if it had never been cut.

use std::ops::ControlFlow;
use std::path::Path;

use flow_core::output::StorageError;
use flow_core::output::checkpoint::{Checkpoint, decode, encode};
use flow_core::run::{Counters, Observer, Progress, Quiet, Record, Scene, Simulation, StopReason};

const SWITCHES: &str = "[{ time = 0.002, gauge = 'graded', grading = 'exp(0.5*cos(6*pi*s))' }, \
                        { time = 0.005, gauge = 'scaled-arc-length' }]";

fn shipped(name: &str, changes: &[(&str, &str)]) -> Scene {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    let changes: Vec<_> = changes.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
    Scene::parse_with(text, name, &changes).expect("valid")
}

/// Two lobes that adhesion brings together, with a frame of the schedule before and one after the contact, in its step.
const NECK: &str = "
curve = { shape = 'parametric', x = '2*cos(phi)', y = 'sin(phi)*(0.15 + 0.85*cos(phi)^2)' }
energy.bending.rigidity = 0.05
energy.length = { penalty = 10.0, target_ratio = 1.0 }
energy.adhesion.kernel = '-0.5*exp(-q/0.05)'
flow.stop_on_contact = true
time.end = 5.0
accuracy.tolerance = 1e-5
output.times = [0.1, 0.139, 0.143, 0.15]
";

fn scenes() -> Vec<Scene> {
    vec![
        Scene::parse(NECK, "neck").expect("valid"),
        Scene::parse_with(NECK, "neck", &[("accuracy.linear_solver".into(), "banded".into())])
            .expect("valid"),
        shipped("three_fold", &[("accuracy.nodes", "128"), ("time.end", "0.05")]),
        shipped("length_penalty", &[]),
        shipped("three_fold", &[("accuracy.nodes", "auto"), ("time.end", "0.01")]),
        shipped(
            "three_fold_sharp",
            &[("accuracy.nodes", "auto"), ("flow.gauge", "graded"), ("time.end", "0.002")],
        ),
        shipped("length_penalty", &[("flow.switch", SWITCHES)]),
        shipped(
            "length_penalty",
            &[("flow.switch", "[{ time = 0, gauge = 'graded' }, { time = 0.005, gauge = 'co-moving' }]")],
        ),
        shipped(
            "three_fold",
            &[("accuracy.nodes", "128"), ("time.end", "0.02"), ("flow.gauge", "co-moving")],
        ),
        shipped("incompressible", &[("flow.normal_mobility", "incompressible-area-preserving")]),
        // Nearly all of its energy is a constant of the motion, and its steps and its rest are judged by the remainder.
        shipped(
            "incompressible",
            &[
                ("energy.bending.preferred_curvature", "1000"),
                ("time", "{ end = 10, stop_at_equilibrium = true }"),
                ("accuracy.tolerance", "1e-3"),
            ],
        ),
        shipped("adhesion", &[("time.end", "0.02"), ("accuracy.derivative", "central-4")]),
        shipped("membrane_penalty", &[("accuracy.linear_solver", "banded")]),
        shipped(
            "membrane_penalty",
            &[
                ("density", "[{ name = 'membrane', initial = 1, mobility = 'exchange' }]"),
                ("energy.membrane.epsilon", "1e-7"),
            ],
        ),
        // Stopped by the watch over the dissipation, and held at rest by that over the energy.
        shipped(
            "circle",
            &[
                ("accuracy.nodes", "32"),
                ("energy.length", "{ penalty = 20, target_ratio = 1.1 }"),
                ("time", "{ end = 1e9 }"),
            ],
        ),
        shipped(
            "figure_eight",
            &[
                ("flow.normal_mobility", "area-preserving"),
                ("time", "{ end = 1e9, stop_at_equilibrium = false }"),
            ],
        ),
    ]
}

fn finish(mut simulation: Simulation) -> Record {
    while simulation.step(&mut Quiet) {}
    simulation.into_record()
}

/// Through bytes, as another process would.
fn passed_on(simulation: &Simulation) -> Simulation {
    let path = Path::new("test.checkpoint");
    let bytes = encode(simulation);
    decode(&bytes, path).expect("whole").simulation(path).expect("of this scene")
}

fn assert_same(one: &Record, other: &Record, what: &str) {
    let without_time = |record: &Record| Counters { integration_seconds: 0.0, ..record.counters };
    assert_eq!(without_time(one), without_time(other), "{what}");
    assert_eq!(one.steps, other.steps, "{what}");
    assert_eq!(one.frames.len(), other.frames.len(), "{what}");
    for (a, b) in one.frames.iter().zip(&other.frames) {
        assert!(a == b, "{what}: the frames at t = {} differ", a.time);
    }
    let text = |record: &Record| (record.scene.clone(), record.resolved_scene.clone());
    assert_eq!(text(one), text(other), "{what}");
    assert_eq!(one.stop_reason, other.stop_reason, "{what}");
}

#[test]
fn a_run_cut_anywhere_goes_on_to_the_same_bits() {
    let mut cuts = 0;
    for scene in scenes() {
        let whole = finish(Simulation::new(&scene).unwrap());
        let steps = whole.counters.steps;
        // Step 0, the first ones, which have no full history, some between, the last but one.
        let mut at = vec![0, 1, 2, 5, 11, steps / 3, steps / 2, 2 * steps / 3, steps - 1];
        at.extend((1..8).map(|k| k * 2_654_435_761 % steps));
        for cut in at {
            let mut simulation = Simulation::new(&scene).unwrap();
            for _ in 0..cut {
                assert!(simulation.step(&mut Quiet));
            }
            let resumed = finish(passed_on(&simulation));
            assert_same(&whole, &resumed, &format!("{}, cut after step {cut} of {steps}", scene.title));
            cuts += 1;
        }
    }
    println!("{cuts} cuts");
}

#[test]
fn a_run_handed_on_after_every_step_goes_on_to_the_same_bits() {
    for scene in scenes() {
        let whole = finish(Simulation::new(&scene).unwrap());
        let mut simulation = Simulation::new(&scene).unwrap();
        while simulation.step(&mut Quiet) {
            simulation = passed_on(&simulation);
        }
        assert_same(&whole, &simulation.into_record(), &scene.title);
    }
}

/// Stops after a number of steps.
struct After(u64);

impl Observer for After {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        if progress.steps == self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn an_interrupted_run_goes_on_to_the_same_bits() {
    for scene in scenes() {
        let whole = finish(Simulation::new(&scene).unwrap());
        for steps in [1, 7, whole.counters.steps / 2] {
            let mut simulation = Simulation::new(&scene).unwrap();
            while simulation.step(&mut After(steps)) {}
            assert_eq!(simulation.stop_reason(), Some(&StopReason::Interrupted));
            let resumed = finish(passed_on(&simulation));
            assert_same(&whole, &resumed, &format!("{}, interrupted at step {steps}", scene.title));
        }
    }
}

/// With its last frame as it was, which is not one of the schedule.
#[test]
fn a_run_that_is_over_stays_so() {
    for scene in scenes() {
        let mut simulation = Simulation::new(&scene).unwrap();
        while simulation.step(&mut Quiet) {}
        let mut resumed = passed_on(&simulation);
        assert_eq!(resumed.stop_reason(), simulation.stop_reason(), "{}", scene.title);
        assert!(!resumed.step(&mut Quiet), "{}", scene.title);
        assert_same(&simulation.into_record(), &resumed.into_record(), &scene.title);
    }
}

/// Checksums keep accidents out, not intent: what does not fit is refused before it is used.
#[test]
fn a_whole_checkpoint_that_does_not_fit_is_refused() {
    let scene =
        shipped("three_fold", &[("accuracy.nodes", "32"), ("curve", "{ shape = 'circle', radius = 1 }")]);
    let mut simulation = Simulation::new(&scene).unwrap();
    for _ in 0..5 {
        simulation.step(&mut Quiet);
    }
    let path = Path::new("test.checkpoint");
    let refused = |change: &dyn Fn(&mut Checkpoint)| {
        let mut checkpoint = decode(&encode(&simulation), path).unwrap();
        change(&mut checkpoint);
        match checkpoint.simulation(path) {
            Err(StorageError::ForeignCheckpoint { reason, .. }) => reason,
            other => panic!("{other:?}"),
        }
    };
    let mut whole = decode(&encode(&simulation), path).unwrap();
    assert!(whole.frames.len() > 1 && whole.steps.time.len() == 5);
    whole.frames[0].fields.clear();
    assert!(whole.simulation(path).is_ok());
    assert!(refused(&|checkpoint| checkpoint.frames[0].time = f64::NAN).contains("times of the frames"));
    assert!(refused(&|checkpoint| checkpoint.frames[0].mass.clear()).contains("values of the frames"));
    assert!(
        refused(&|checkpoint| checkpoint.frames[0].density[0].truncate(3)).contains("values of the frames")
    );
    assert!(refused(&|checkpoint| checkpoint.frames.clear()).contains("the frames"));
    assert!(refused(&|checkpoint| checkpoint.steps.order.clear()).contains("log of steps"));
    let shorter = refused(&|checkpoint| {
        let resolved = &mut checkpoint.scene.resolved;
        let end = format!("end = {:?}", Scene::parse(resolved, "resolved").unwrap().time.end);
        *resolved = resolved.replace(&end, "end = 1e-300");
    });
    assert!(shorter.contains("the time"), "{shorter}");
    assert!(refused(&|checkpoint| checkpoint.scene.resolved.clear()).contains("`curve` is missing"));
}

#[test]
fn damage_is_recognised() {
    let mut simulation = Simulation::new(&shipped("circle", &[("accuracy.nodes", "32")])).unwrap();
    for _ in 0..5 {
        simulation.step(&mut Quiet);
    }
    let path = Path::new("test.checkpoint");
    let bytes = encode(&simulation);
    assert!(decode(&bytes, path).is_ok());
    for length in 0..bytes.len() {
        assert!(decode(&bytes[..length], path).is_err(), "truncated to {length} bytes");
    }
    for bit in 0..8 * bytes.len() {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let error = decode(&flipped, path).expect_err("one bit is wrong");
        assert!(error.is_unreadable_file(), "{error}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    assert!(matches!(decode(&longer, path), Err(StorageError::DamagedCheckpoint { .. })));
    println!("{} truncations, {} flips", bytes.len(), 8 * bytes.len());
}
