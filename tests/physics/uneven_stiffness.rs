//! Curves whose second derivative of the energy varies by a hundred along them, on more nodes than a band has at first.

use flow_core::run::{Quiet, Scene, run};

/// Krylov iterations of a solve in the mean, on 2048 nodes from the start to `end`.
fn iterations(normal_mobility: &str, end: f64) -> f64 {
    let text = format!(
        "curve = {{ shape = 'polar', r = '1 + 0.4*cos(3*phi)' }}
        energy = {{ local.expression = '0.5*kappa^4', bending.rigidity = 5.0 }}
        flow.normal_mobility = '{normal_mobility}'
        accuracy = {{ tolerance = 1e-3, nodes = 2048 }}
        time = {{ end = {end:e}, stop_at_equilibrium = false }}"
    );
    let scene = Scene::parse(&text, "uneven").expect("a valid scene");
    let counters = run(&scene, &mut Quiet).expect("a good start").counters;
    let mean = counters.krylov_iterations as f64 / counters.newton_iterations as f64;
    println!("{normal_mobility}: {} steps, {mean:.1} iterations a solve", counters.steps);
    mean
}

/// Means along the curve, which are left to the symbol for high modes, took 24 iterations, and 30.
#[test]
fn high_modes_have_a_band_where_the_symbol_does_not_serve() {
    assert!(iterations("identity", 1e-7) < 12.0);
    assert!(iterations("surface-diffusion", 1e-11) < 12.0);
}
