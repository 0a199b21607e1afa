//! Decay of the modes of a circle under each mobility, by runs and by the implicit operator.

use std::f64::consts::TAU;

use curveflow_tests::{assert_close, last, run, scene, shipped};
use flow_core::integrator::Problem;
use flow_core::run::{Frame, Setup};

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

/// Curve of the perturbed unit circle.
fn start(mode: usize, end: f64) -> String {
    format!(
        "
        curve = {{ shape = 'polar', r = '1 + 1e-4*cos({mode}*phi)' }}
        energy.bending.rigidity = 1.0
        time = {{ end = {end:?}, stop_at_equilibrium = false }}
        accuracy = {{ tolerance = 1e-9, nodes = 128 }}
        output.frames = 1
        "
    )
}

/// Asserts that ln(η₀/η) over `clock` is `rate` to 1e-4, for the run of `scene`.
fn assert_decay(text: &str, mode: usize, rate: f64, clock: f64) {
    let record = run(&scene(text));
    let (first, last) = (amplitude(&record.frames[0], mode), amplitude(last(&record), mode));
    let measured = (first / last).ln() / clock;
    let error = measured / rate - 1.0;
    println!("n = {mode}: rate {measured:.6}, exact {rate:.6}, error {error:.1e}");
    // The tolerance is relative to the whole curvature, of which the mode is n² × 1e-4; squares of the
    // amplitude add (n² × 1e-4)² at most.
    assert!(error.abs() < 1e-4, "n = {mode}: rate {measured}, exact {rate}");
}

/// About the growing circle η′ = −λη/R⁴ with R⁴ = 1 + 2t, λ = (n² − 1)(n² − 3/2), hence η = η₀(1 + 2t)^{−λ/2}.
#[test]
fn modes_of_a_circle_decay_at_the_known_rates() {
    for mode in 2..=8_usize {
        let square = (mode * mode) as f64;
        let rate = (square - 1.0) * (square - 1.5);
        let end = 1.0 / rate;
        assert_decay(&start(mode, end), mode, rate, 0.5 * (1.0 + 2.0 * end).ln());
    }
}

/// The total length fixed by a stiff penalty: λ = (n² − 1)².
#[test]
fn modes_of_a_circle_of_fixed_length_decay_at_the_known_rates() {
    for mode in 2..=8_usize {
        let rate = ((mode * mode) as f64 - 1.0).powi(2);
        let end = 1.0 / rate;
        let text = start(mode, end) + "energy.length = { penalty = 1e6, target_ratio = 1.0 }\n";
        assert_decay(&text, mode, rate, end);
    }
}

/// Every piece of the curve of fixed length: λ = n²(n² − 1)²/(n² + 1).
#[test]
fn modes_of_an_incompressible_circle_decay_at_the_known_rates() {
    for mode in 2..=8_usize {
        let square = (mode * mode) as f64;
        let rate = square * (square - 1.0).powi(2) / (square + 1.0);
        let end = 1.0 / rate;
        let text = start(mode, end) + "flow.normal_mobility = 'incompressible'\n";
        assert_decay(&text, mode, rate, end);
    }
}

/// Length and area fix the amplitude of a single mode: it rests.
#[test]
fn a_mode_of_a_circle_of_kept_length_and_area_rests() {
    let text = start(3, 0.1) + "flow.normal_mobility = 'incompressible-area-preserving'\n";
    let record = run(&scene(&text));
    let (first, last) = (amplitude(&record.frames[0], 3), amplitude(last(&record), 3));
    assert!((last / first - 1.0).abs() < 1e-4, "{first:.6e} → {last:.6e}");
}

/// The H⁻¹ flow has mean zero, so that the circle rests: λ = n²(n² − 1)(n² − 3/2).
#[test]
fn modes_of_a_circle_under_surface_diffusion_decay_at_the_known_rates() {
    for mode in 2..=6_usize {
        let square = (mode * mode) as f64;
        let rate = square * (square - 1.0) * (square - 1.5);
        let end = 1.0 / rate;
        let text = start(mode, end) + "flow.normal_mobility = 'surface-diffusion'\n";
        assert_decay(&text, mode, rate, end);
    }
}

/// A circle at rest under bending and a length penalty, 1/(2R²) = β(2πR − target): the implicit operator −𝓚 Hess 𝓕ₕ is
/// the Jacobian there, and each mode is an eigenvector of it, with the rate of fixed length −(n² − 1)²/R⁴.
#[test]
fn the_implicit_operator_has_the_known_rates_at_a_circle_at_rest() {
    let (radius, penalty) = (1.5, 7.0);
    let target = TAU * radius - 0.5 / (radius * radius * penalty);
    let setup = Setup::new(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = {radius:?} }}
        energy.bending.rigidity = 1.0
        energy.length = {{ penalty = {penalty:?}, target = {target:?} }}
        time.end = 1.0
        accuracy = {{ tolerance = 1e-6, nodes = 64 }}
        "
    )));
    let Setup { mut membrane, state, .. } = setup.expect("a circle");
    let (mut rate, mut motion) = (vec![0.0; state.len()], vec![0.0; state.len()]);
    membrane.linearise(&state, &mut rate);
    assert!(rate.iter().all(|rate| rate.abs() < 1e-10), "at rest");
    for mode in 2..=8_usize {
        motion.fill(0.0);
        motion[2 * mode] = 1.0;
        membrane.jacobian_product(&motion, &mut rate);
        let exact = -((mode * mode) as f64 - 1.0).powi(2) / radius.powi(4);
        assert_close(rate[2 * mode], exact, 1e-11);
        rate[2 * mode] = 0.0;
        assert!(rate.iter().all(|rest| rest.abs() < 1e-9 * exact.abs()), "mode {mode} is an eigenvector");
    }
}

/// A wall for the length is in the linear part of exponential steps, however stiff: they take no implicit solves for it.
#[test]
fn a_stiff_length_leaves_the_steps_exponential() {
    let steps = |penalty| {
        let record = run(&shipped("length_penalty", &[("energy.length.penalty", penalty)]));
        assert_eq!(record.counters.jacobian_products, 0, "{penalty}: {:?}", record.counters);
        record.counters.steps
    };
    let (soft, stiff) = (steps("5"), steps("1e6"));
    assert!(stiff < 2 * soft, "{soft} and {stiff} steps");
}
