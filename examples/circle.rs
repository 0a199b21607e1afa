//! A circle under bending against its exact law R(t) = (1 + 2t)^(1/4).
//!
//! `cargo run --release -p curveflow-examples --bin circle`

use std::error::Error;
use std::f64::consts::TAU;

use flow_core::run::{Quiet, Scene, run};

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::parse(
        "
        curve = { shape = 'circle', radius = 1.0 }
        energy.bending.rigidity = 1.0
        time = { end = 1.0, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-8, nodes = 64 }
        output.frames = 5
        ",
        "circle",
    )?;
    let record = run(&scene, &mut Quiet)?;
    println!("   t        R           exact       error");
    for frame in &record.frames {
        let (radius, exact) = (frame.length / TAU, (1.0 + 2.0 * frame.time).powf(0.25));
        println!("{:6.3}  {radius:.8}  {exact:.8}  {:8.1e}", frame.time, radius / exact - 1.0);
    }
    println!("{} steps", record.counters.steps);
    Ok(())
}
