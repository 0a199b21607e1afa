//! A term from outside in a whole run: the same as the formula of it in the scene, whatever nodes and gauge the run takes.

use std::path::Path;

use flow_core::energies::{EnergyTerm, TermFault};
use flow_core::output::checkpoint;
use flow_core::run::{Quiet, ResumeError, Scene, SetupError, Simulation, StopReason};

use crate::parts::Quartic;
use crate::refusal::Barrier;

const QUARTIC: f64 = 0.3;

fn scene(energy: &str) -> Scene {
    let text = format!(
        "
        curve = {{ shape = 'ellipse', semi_axes = [1.4, 0.8] }}
        density = [{{ name = 'protein', initial = '1 + 0.2*sin(2*pi*s)', mobility = 'diffusion' }}]
        energy.length.tension = 0.2
        energy.bending.rigidity = 0.5
        energy.membrane = {{ density = 'protein', epsilon = 0.5 }}
        {energy}
        time = {{ end = 0.3, stop_at_equilibrium = false, max_steps = 1000 }}
        accuracy = {{ tolerance = 1e-6, nodes = 'auto' }}
        output = {{ frames = 6, fields = ['energy-densities', 'normal-velocities'] }}
        [[flow.switch]]
        time = 0.1
        gauge = 'co-moving'
        "
    );
    Scene::parse(&text, "a test").expect("a scene")
}

fn own(_: usize) -> Vec<Box<dyn EnergyTerm>> {
    vec![Box::new(Quartic(QUARTIC))]
}

#[test]
fn an_own_term_runs_as_its_formula_does() {
    let mut told = Simulation::new(&scene("energy.local.expression = '0.3/4*kappa^4*(1 + protein^2)'"))
        .expect("a start");
    let mut own = Simulation::with_terms(&scene(""), own).expect("a start");
    for simulation in [&mut told, &mut own] {
        assert!(!simulation.run_until(f64::INFINITY, u64::MAX, &mut Quiet));
        assert_eq!(simulation.stop_reason(), Some(&StopReason::EndTime));
    }
    println!("{:?}", own.counters());
    assert!(own.counters().remaps > 1, "the nodes, and the gauge");
    let (told, own) = (told.into_record(), own.into_record());
    assert_eq!(own.energy_terms, ["bending", "length", "membrane", "quartic"]);
    for field in ["energy_density_quartic", "normal_velocity_quartic"] {
        assert!(own.fields.iter().any(|name| name == field), "{:?}", own.fields);
    }
    for (told, own) in told.frames.iter().zip(&own.frames) {
        assert!((told.energy / own.energy - 1.0).abs() < 1e-6, "{} ≠ {}", told.energy, own.energy);
        assert!(own.energy_balance.abs() < 1e-5 * own.energy);
    }
}

#[test]
fn a_run_with_own_terms_resumes_with_them_alone() {
    let scene = scene("");
    let mut unbroken = Simulation::with_terms(&scene, own).expect("a start");
    unbroken.run_until(0.2, u64::MAX, &mut Quiet);
    assert!(unbroken.counters().remaps > 0);
    let kept = |simulation: &Simulation| {
        (simulation.memory(), simulation.frames().to_vec(), simulation.steps().clone())
    };
    let (memory, frames, steps) = kept(&unbroken);
    let without = Simulation::resume(&scene, memory, frames, steps);
    let missing = ResumeError::TermsMissing { saved: 4, known: 3 }.to_string();
    assert_eq!(without.err().map(|error| error.to_string()), Some(missing));
    let (memory, frames, steps) = kept(&unbroken);
    let mut resumed =
        Simulation::resume_with_terms(&scene, own, memory, frames, steps).expect("its own memory");
    for simulation in [&mut unbroken, &mut resumed] {
        simulation.run_until(f64::INFINITY, u64::MAX, &mut Quiet);
    }
    assert_eq!(unbroken.state(), resumed.state());
    assert_eq!(unbroken.counters().steps, resumed.counters().steps);
}

#[test]
fn what_is_left_of_a_run_knows_its_own_terms() {
    let mut simulation = Simulation::with_terms(&scene(""), own).expect("a start");
    simulation.run_until(0.05, u64::MAX, &mut Quiet);
    assert_eq!(simulation.record().own_terms, ["quartic"]);
    let (bytes, path) = (checkpoint::encode(&simulation), Path::new("own.checkpoint"));
    let saved = || checkpoint::decode(&bytes, path).expect("a checkpoint");
    let error = saved().simulation(path).expect_err("the term is missing").to_string();
    assert!(error.contains("from outside") && error.contains("resume_with_terms"), "{error}");
    let mut resumed = saved().simulation_with_terms(path, own).expect("its own memory");
    assert_eq!(resumed.state(), simulation.state());
    assert_eq!(resumed.into_record().own_terms, ["quartic"]);
    assert!(Simulation::new(&scene("")).expect("a start").into_record().own_terms.is_empty());
}

#[test]
fn names_of_own_terms_are_keys() {
    let scene = scene("");
    let twice = |_| -> Vec<Box<dyn EnergyTerm>> { vec![Box::new(Quartic(0.1)), Box::new(Quartic(0.2))] };
    let error = Simulation::with_terms(&scene, twice).err();
    assert!(matches!(error, Some(SetupError::TermName { name: "quartic" })), "{error:?}");
}

#[test]
fn a_start_that_an_own_term_refuses_makes_no_simulation() {
    let barrier = |_| -> Vec<Box<dyn EnergyTerm>> { vec![Box::new(Barrier { strength: 0.1, most: 1.2 })] };
    let error = Simulation::with_terms(&scene(""), barrier).err();
    assert!(
        matches!(error, Some(SetupError::Term(TermFault::OutOfRange { term: "barrier", .. }))),
        "{error:?}"
    );
}
