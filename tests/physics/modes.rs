//! Decay of the modes of a circle under plain bending.

use std::f64::consts::TAU;

use curveflow_tests::{last, run, scene};
use flow_core::run::Frame;

/// Amplitude of cos(nφ) in the radius, from the curvature: K = 2π + 2π(n² − 1)(η/R) cos(nφ) to first order.
fn amplitude(frame: &Frame, mode: usize) -> f64 {
    let nodes = frame.curvature.len();
    let part = |turn: fn(f64) -> f64| {
        let wave = |i: usize| turn(TAU * ((mode * i) % nodes) as f64 / nodes as f64);
        frame.curvature.iter().enumerate().map(|(i, kappa)| kappa * wave(i)).sum::<f64>()
    };
    let curvature = 2.0 / nodes as f64 * part(f64::cos).hypot(part(f64::sin));
    let radius = frame.length / TAU;
    let square = (mode * mode) as f64;
    curvature * radius * radius / (square - 1.0)
}

/// About the growing circle η′ = −λη/R⁴ with R⁴ = 1 + 2t, λ = (n² − 1)(n² − 3/2), hence η = η₀(1 + 2t)^{−λ/2}.
#[test]
fn modes_of_a_circle_decay_at_the_known_rates() {
    for mode in 2..=6_usize {
        let square = (mode * mode) as f64;
        let rate = (square - 1.0) * (square - 1.5);
        let end = 1.0 / rate;
        let record = run(&scene(&format!(
            "
            curve = {{ shape = 'polar', r = '1 + 1e-4*cos({mode}*phi)' }}
            energy.bending.rigidity = 1.0
            time = {{ end = {end:?}, stop_at_equilibrium = false }}
            accuracy = {{ tolerance = 1e-9, nodes = 128 }}
            output.frames = 1
            "
        )));
        let (first, last) = (amplitude(&record.frames[0], mode), amplitude(last(&record), mode));
        let measured = (first / last).ln() / (0.5 * (1.0 + 2.0 * end).ln());
        let error = measured / rate - 1.0;
        println!("n = {mode}: rate {measured:.6}, exact {rate}, error {error:.1e}");
        // The tolerance is relative to the whole curvature, of which the mode is n² × 1e-4; squares of the
        // amplitude add (n² × 1e-4)² at most.
        assert!(error.abs() < 1e-4, "n = {mode}: rate {measured}, exact {rate}");
    }
}
