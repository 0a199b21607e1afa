//! The energy of a scene on arrays is that of the curve that they are, wherever its nodes lie.

use std::f64::consts::{PI, TAU};

use flow_core::run::{EvaluationError, Scene, evaluate};

const NODES: u32 = 64;

/// A circle of radius 2 in the metric 4π(1 + a cos 2πs).
fn circle(a: f64) -> (Vec<f64>, Vec<f64>) {
    let metric = |i: u32| 2.0 * TAU * (1.0 + a * (TAU * f64::from(i) / f64::from(NODES)).cos());
    (vec![0.5; NODES as usize], (0..NODES).map(metric).collect())
}

fn scene(flow: &str) -> Scene {
    let text = format!(
        "
        curve = {{ shape = 'circle', radius = 1.0 }}
        density = [{{ name = 'a', initial = 0.5, mobility = 'diffusion' }}]
        energy.bending.rigidity = 1.0
        energy.local.expression = 'a^2'
        flow = {{ {flow} }}
        time.end = 1.0
        "
    );
    Scene::parse(&text, "test").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_gauge_is_one_that_has_the_metric_of_the_arrays() {
    let switch = "switch = [{ time = 0.1, gauge = 'graded', grading = '1 + 0.5*cos(2*pi*s)' }]";
    for flow in ["gauge = 'scaled-arc-length'", "gauge = 'graded'", "gauge = 'co-moving'", switch] {
        for a in [0.0, 0.3] {
            let (curvature, metric) = circle(a);
            // ½ − a cos 2πs.
            let density: Vec<f64> = metric.iter().map(|g| 1.5 - g / (2.0 * TAU)).collect();
            let found = evaluate(&scene(flow), &curvature, &metric, &[&density]).expect("a curve");
            // ½∫κ² = π/2, and 4π⟨(1 + ac)(½ − ac)²⟩ = π with c = cos 2πs; at equal distances that were 2πa² more.
            let expected = 1.5 * PI;
            assert!(
                (found.energy / expected - 1.0).abs() < 1e-12,
                "{flow}, {a}: {} {expected}",
                found.energy
            );
        }
    }
}

#[test]
fn arrays_of_another_number_of_densities_are_refused() {
    let (curvature, metric) = circle(0.0);
    let error = evaluate(&scene("gauge = 'graded'"), &curvature, &metric, &[]).expect_err("one is missing");
    assert!(matches!(error, EvaluationError::Densities { expected: 1, found: 0 }), "{error}");
}
