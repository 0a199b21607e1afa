//! Laws of the circle.

use std::f64::consts::TAU;

use curveflow_tests::{assert_close, last, run, scene, shipped};
use flow_core::run::StopReason;

/// Largest distance of the curvature from that of the circle of the frame's length, relative.
fn out_of_round(frame: &flow_core::run::Frame) -> f64 {
    let round = TAU / frame.length;
    frame.curvature.iter().fold(0.0, |largest, kappa| (kappa / round - 1.0).abs().max(largest))
}

#[test]
fn bending_drives_a_circle_as_the_fourth_root_of_time() {
    let record = run(&shipped("circle", &[]));
    for frame in &record.frames {
        let radius = (1.0 + 2.0 * frame.time).powf(0.25);
        // The scene asks for 1e-8 per step.
        assert_close(frame.length, TAU * radius, 1e-7);
        assert_close(frame.energy, 0.5 * TAU / radius, 1e-7);
        assert_close(frame.normal_velocity[0], 0.5 / radius.powi(3), 1e-6);
        // What the implicit solves leave, which stop below the tolerance.
        assert!(out_of_round(frame) < 1e-8, "{:.1e}", out_of_round(frame));
    }
    assert_eq!(record.stop_reason, StopReason::EndTime);
}

#[test]
fn tension_shortens_a_circle_as_the_square_root_of_time() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.0 }
        energy.length.tension = 1.0
        time = { end = 0.4, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-8, nodes = 64 }
        output.frames = 20
        ",
    ));
    for frame in &record.frames {
        // Errors of R² stay, so that those of R grow fivefold until R² = 0.2 (measured: 1e-6 after some 100 steps).
        assert_close(frame.length, TAU * (1.0 - 2.0 * frame.time).sqrt(), 3e-6);
    }
    assert_eq!(record.stop_reason, StopReason::EndTime);
}

#[test]
fn a_circle_with_a_length_penalty_comes_to_rest_where_the_forces_balance() {
    let (penalty, radius, ratio) = (5.0, 1.0, 1.3);
    let record = run(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = {radius:?} }}
        energy.bending.rigidity = 1.0
        energy.length = {{ penalty = {penalty:?}, target_ratio = {ratio:?} }}
        time = {{ end = 100.0 }}
        accuracy = {{ tolerance = 1e-7, nodes = 64 }}
        "
    )));
    // 1/(2R²) = β(2πR − σ|Γ₀|), by bisection.
    let excess = |r: f64| penalty * TAU * (r - ratio * radius) - 0.5 / (r * r);
    let (mut low, mut high) = (0.5, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if excess(middle) > 0.0 { &mut high } else { &mut low }) = middle;
    }
    let frame = last(&record);
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert!(frame.time < 100.0);
    // Equilibrium is called at 1e-9 of the energy, hence within its root, 3e-5, of the radius.
    assert_close(frame.length, TAU * low, 3e-5);
}
