//! What rounding leaves of the velocity of the unit circle under bending, exactly ½.

use flow_core::run::Simulation;

/// Numbers of nodes.
pub const NODES: [usize; 6] = [64, 256, 1024, 4096, 16384, 65536];
/// Derivative families, as scenes name them.
pub const FAMILIES: [&str; 5] = ["fourier", "central-2", "central-4", "central-6", "central-8"];

/// Largest relative error of the velocity over the nodes.
///
/// # Panics
/// If the scene makes no initial state.
#[must_use]
pub fn error(nodes: usize, family: &str) -> f64 {
    let scene = crate::scene(&format!(
        "curve = {{ shape = 'circle', radius = 1.0 }}\nenergy.bending.rigidity = 1.0\ntime.end = 1.0\n\
         accuracy = {{ nodes = {nodes}, derivative = '{family}' }}"
    ));
    let simulation = Simulation::new(&scene).unwrap_or_else(|error| panic!("{error}"));
    let velocity = &simulation.frames()[0].normal_velocity;
    velocity.iter().fold(0.0, |worst: f64, v| worst.max((v / 0.5 - 1.0).abs()))
}
