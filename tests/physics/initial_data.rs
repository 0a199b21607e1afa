//! Initial data finer than the nodes that are looked at first: waves that look like longer ones there.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::f64::consts::{PI, TAU};

use flow_core::run::{Counters, Quiet, Record, Scene, SetupError, Simulation, run, warnings};

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

/// Smooth data that need more than the nodes that kinks get: an ellipse with a curvature of 400 at its ends.
#[test]
fn sharp_ends_get_the_nodes_that_they_need() {
    let (a, b) = (1.0_f64, 0.05_f64);
    let count = 20_000;
    let angles = (0..count).map(|i| TAU * f64::from(i) / f64::from(count));
    let density = |angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        (a * b).powi(2) / ((a * sine).powi(2) + (b * cosine).powi(2)).powf(2.5)
    };
    let energy = 0.5 * angles.map(density).sum::<f64>() * TAU / f64::from(count);
    for tolerance in ["1e-5", "1e-7"] {
        let rest = format!("energy.bending.rigidity = 1.0\naccuracy.tolerance = {tolerance}");
        let record = record(&format!("shape = 'ellipse', semi_axes = [{a}, {b}]"), &rest);
        let found = record.frames[0].energy;
        println!("{tolerance}: {found}, {energy}, {} nodes", record.steps.nodes[0]);
        assert!((found / energy - 1.0).abs() < 1e-7, "{tolerance}: {found}, {energy}");
        assert!(record.steps.nodes[0] > 4096, "{tolerance}: {} nodes", record.steps.nodes[0]);
    }
}

/// Nothing smooths a density that is only carried along: a front gets its nodes, a jump cannot, and that is told.
#[test]
fn fronts_that_stay_are_resolved_and_jumps_that_stay_are_told() {
    let front = |steepness: f64| {
        let rest = format!(
            "density = [{{ name = 'a', initial = '0.5 + 0.5*tanh({steepness:e}*(cos(2*pi*s) - 0.3))', mobility = 'none' }}]
            energy.bending.rigidity = 1.0"
        );
        record("shape = 'circle', radius = 1.0", &rest)
    };
    let mass = 2.0 * 0.3_f64.acos(); // of a front of no width
    let resolved = front(1e3);
    assert!((resolved.frames[0].mass[0] / mass - 1.0).abs() < 1e-6, "{}", resolved.frames[0].mass[0]);
    assert_eq!(resolved.counters.unresolved_steps, 0);
    let jump = front(1e7);
    assert!((jump.frames[0].mass[0] / mass - 1.0).abs() < 1e-4, "{}", jump.frames[0].mass[0]);
    let told = warnings(&jump);
    assert!(told.iter().any(|told| told.contains("smoother initial data")), "{told:?}, {:?}", jump.counters);
}

/// Points that were rounded to nine digits are a curve with waves as short as their distances, which the flow smooths. On fewer nodes
/// they looked like long ones: the energy was 3e-4 off.
#[test]
fn rounded_points_end_where_the_curve_does_that_they_are_of() {
    let place = |i: u32| {
        let angle = TAU * f64::from(i) / 1e4;
        let radius = 1.0 + 0.2 * (3.0 * angle).cos();
        format!("[{:.9}, {:.9}]", radius * angle.cos(), 0.8 * radius * angle.sin())
    };
    let points = (0..10_000).map(place).collect::<Vec<_>>().join(", ");
    let formula =
        "shape = 'parametric', x = '(1 + 0.2*cos(3*phi))*cos(phi)', y = '0.8*(1 + 0.2*cos(3*phi))*sin(phi)'";
    let energy = |curve: &str| {
        let text = format!(
            "curve = {{ {curve} }}
            energy = {{ bending.rigidity = 1.0, length = {{ penalty = 10.0, target_ratio = 1.2 }} }}
            time = {{ end = 0.02, stop_at_equilibrium = false }}
            accuracy.tolerance = 1e-5"
        );
        let record = run(&Scene::parse(&text, "points.toml").unwrap(), &mut Quiet).unwrap();
        record.frames.last().unwrap().energy
    };
    let [found, exact] = [energy(&format!("shape = 'points', points = [{points}]")), energy(formula)];
    println!("{found}, {exact}");
    assert!((found / exact - 1.0).abs() < 1e-5, "{found}, {exact}");
}
