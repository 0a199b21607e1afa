//! Laws of the circle.

use std::f64::consts::TAU;

use curveflow_tests::{assert_close, bisection, last, run, scene, shipped};
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

/// From the rate alone they would be 7, 13 and 19, the first of them a tenth as long.
#[test]
fn steps_start_with_the_slope_of_the_rate() {
    for (tolerance, most) in [("1e-3", 5), ("1e-5", 11), ("1e-7", 16)] {
        let record = run(&shipped("circle", &[("accuracy.tolerance", tolerance)]));
        assert_eq!(record.steps.order[0], 3, "order of the first corrector");
        let steps = record.counters.steps;
        assert!(steps <= most, "{steps} steps at {tolerance}");
        assert_close(last(&record).length, TAU * 3.0_f64.powf(0.25), tolerance.parse().unwrap());
    }
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
    let balance = bisection([0.5, 3.0], |r| penalty * TAU * (r - ratio * radius) - 0.5 / (r * r));
    let frame = last(&record);
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert!(frame.time < 100.0);
    // Equilibrium is called at 1e-9 of the energy, hence within its root, 3e-5, of the radius.
    assert_close(frame.length, TAU * balance, 3e-5);
}

#[test]
fn a_membrane_on_a_circle_stretches_by_its_compressibility() {
    let (radius, epsilon) = (1.0_f64, 0.05);
    let record = run(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = {radius:?} }}
        density = [{{ name = 'membrane', initial = 1.0, mobility = 'diffusion' }}]
        energy.bending.rigidity = 1.0
        energy.membrane = {{ density = 'membrane', epsilon = {epsilon:?} }}
        time = {{ end = 100.0 }}
        accuracy = {{ tolerance = 1e-7, nodes = 64 }}
        "
    )));
    // π/R + πR(R₀/R − 1)²/ε is least where R² = R₀² + ε.
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert_close(last(&record).length, TAU * (radius * radius + epsilon).sqrt(), 3e-5);
}

#[test]
fn a_packed_circle_comes_to_rest_where_the_forces_balance() {
    let epsilon = 0.2;
    let record = run(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = 1.0 }}
        density = [
            {{ name = 'a', initial = 0.5, mobility = 'diffusion' }},
            {{ name = 'b', initial = 0.5, mobility = 'diffusion' }},
        ]
        energy.bending.rigidity = 1.0
        energy.length.tension = 1.0
        energy.packing = {{ matrix = [[1.5, 0.25], [0.25, 2.0]], epsilon = {epsilon:?} }}
        time = {{ end = 100.0 }}
        accuracy = {{ tolerance = 1e-7, nodes = 32 }}
        "
    )));
    // x = ρᵀPρ = 1/R², and π/R + 2πR + πR(x − 1)²/ε is least where (x − 1)(1 + 3x) = ε(2 − x). The tension keeps x above
    // 1: below, the penalty drives the densities apart.
    let balance = bisection([0.5, 3.0], |r| {
        let x = 1.0 / (r * r);
        epsilon * (2.0 - x) - (x - 1.0) * (1.0 + 3.0 * x)
    });
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert_close(last(&record).length, TAU * balance, 3e-5);
}

#[test]
fn a_circle_grows_by_what_it_lacks_of_the_preferred_curvature() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.0 }
        density = [{ name = 'protein', initial = 1.0, mobility = 'diffusion' }]
        energy.bending = { rigidity = 2.0, preferred_curvature = '0.5*rho' }
        time = { end = 100.0, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-7, nodes = 32 }
        ",
    ));
    // κ = 1/R and c₀ = 1/(2R): the energy πb/(4R) drives R′ = b/(8R³).
    for frame in &record.frames {
        assert_close(frame.length, TAU * (1.0 + frame.time).powf(0.25), 1e-5);
    }
}

#[test]
fn a_general_energy_of_the_curvature_needs_no_density() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.0 }
        energy.local.expression = '0.25*kappa^4'
        time = { end = 1.0, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-8, nodes = 32 }
        ",
    ));
    // E = (π/2)R⁻³, so R′ = (3/4)R⁻⁵.
    for frame in &record.frames {
        assert_close(frame.length, TAU * (1.0 + 4.5 * frame.time).powf(1.0 / 6.0), 1e-6);
    }
}
