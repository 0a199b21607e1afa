//! Initial data finer than the nodes that are looked at first: waves that look like longer ones there.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::f64::consts::{PI, TAU};

use flow_core::run::{Counters, Quiet, Record, Scene, SetupError, Simulation, run};

fn record(curve: &str, rest: &str) -> Record {
    run(&scene(curve, rest), &mut Quiet).unwrap()
}

fn scene(curve: &str, rest: &str) -> Scene {
    let text = format!("curve = {{ {curve} }}\ntime = {{ end = 1e-6, stop_at_equilibrium = false }}\n{rest}");
    Scene::parse(&text, "waves.toml").unwrap()
}

fn density(initial: &str, nodes: &str) -> Record {
    let rest = format!(
        "density = [{{ name = 'a', initial = '{initial}', mobility = 'none' }}]
        energy.local.expression = '0.5*a^2*kappa^2'
        accuracy = {{ tolerance = 1e-5, nodes = {nodes} }}"
    );
    record("shape = 'circle', radius = 1.0", &rest)
}

/// Mass of 0.5 + 0.3 cos(2πms): half of the length for every m.
#[test]
fn waves_of_densities_are_not_taken_for_longer_ones() {
    for waves in [192, 250, 384, 512, 1000] {
        let record = density(&format!("0.5 + 0.3*cos({waves}*2*pi*s)"), "'auto'");
        let first = &record.frames[0];
        assert!((first.mass[0] / PI - 1.0).abs() < 1e-5, "{waves} waves: mass {}", first.mass[0]);
        // ½∫a²κ² = π(0.25 + 0.045).
        assert!((first.energy / (0.295 * PI) - 1.0).abs() < 1e-4, "{waves} waves: energy {}", first.energy);
        assert_eq!(record.counters.unresolved_steps, 0, "{waves} waves");
    }
}

#[test]
fn narrow_bumps_are_seen() {
    for width in [1e-2_f64, 1e-3] {
        let square = width * width;
        let record = density(&format!("0.5 + 0.3*exp(-(s - 0.50137)^2/{square:e})"), "'auto'");
        let mass = PI + 0.3 * TAU * width * PI.sqrt();
        assert!(
            (record.frames[0].mass[0] / mass - 1.0).abs() < 1e-5,
            "{width}: {}",
            record.frames[0].mass[0]
        );
    }
}

/// r = 1 + a cos mφ has the bending energy π + (am²)²π/2 + … at small am.
#[test]
fn waves_of_curves_are_not_taken_for_longer_ones() {
    for waves in [160.0_f64, 250.0, 256.0, 512.0, 1000.0, 1024.0] {
        let amplitude = 1e-3 / waves;
        let curve = format!("shape = 'polar', r = '1 + {amplitude:e}*cos({waves}*phi)'");
        let rest = "energy.bending.rigidity = 1.0\naccuracy = { tolerance = 1e-5, nodes = 'auto' }";
        let record = record(&curve, rest);
        let bending = PI + 0.5 * PI * (1e-3 * waves).powi(2);
        let energy = record.frames[0].energy;
        assert!((energy / bending - 1.0).abs() < 1e-3, "{waves} waves: {energy}, not {bending}");
        let last = record.frames.last().unwrap();
        assert!((last.length / TAU - 1.0).abs() < 1e-5, "{waves} waves: length {}", last.length);
    }
}

#[test]
fn what_no_nodes_see_is_refused_and_what_fixed_ones_miss_is_told() {
    let rest = "density = [{ name = 'a', initial = '0.5 + 0.3*cos(50000*2*pi*s)', mobility = 'diffusion' }]
                energy.local.expression = 'a^2'";
    let error = run(&scene("shape = 'circle', radius = 1.0", rest), &mut Quiet).unwrap_err();
    assert!(matches!(error, SetupError::TooManyNodes { .. }), "{error}");

    let record = density("0.5 + 0.3*cos(250*2*pi*s)", "256");
    let Counters { steps, unresolved_steps, .. } = record.counters;
    assert!(steps > 0 && unresolved_steps == steps, "{unresolved_steps} of {steps}");
    let resolved = density("0.5 + 0.3*cos(20*2*pi*s)", "256");
    assert_eq!(resolved.counters.unresolved_steps, 0);
}

/// Nodes that miss some of a curve leave a gap between its ends.
#[test]
fn a_gap_of_more_than_a_hundredth_of_the_length_is_refused() {
    let start = |nodes| {
        let rest =
            format!("energy.bending.rigidity = 1.0\naccuracy = {{ tolerance = 1e-5, nodes = {nodes} }}");
        let curve = "shape = 'polar', r = '1 + 0.3*cos(5*phi) + 0.1*sin(3*phi)'";
        Simulation::new(&scene(curve, &rest)).map(|simulation| {
            let first = &simulation.frames()[0];
            first.closure_defect / first.length
        })
    };
    let mut refused = false;
    for nodes in (48..=128).step_by(8) {
        match start(nodes) {
            Ok(gap) => assert!(gap <= 1e-2, "{nodes} nodes: a gap of {gap:.1e}"),
            Err(SetupError::TooFewNodes { gap, bound, .. }) => {
                assert!(gap > bound, "{gap} {bound}");
                refused = true;
            }
            Err(SetupError::TurningNumber { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
    assert!(refused && start(512).is_ok_and(|gap| gap < 1e-4));
}
