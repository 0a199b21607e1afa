//! An energy of one's own, as an expression: proteins that prefer curvature 2 where they are dense.
//!
//! The program differentiates the expression itself. `cargo run --release -p curveflow-examples --bin own_energy`

use std::error::Error;

use flow_core::run::{Quiet, Scene, run};

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::parse(
        "
        curve = { shape = 'ellipse', semi_axes = [1.4, 0.9] }
        density = [{ name = 'protein', initial = '0.5 + 0.1*cos(4*pi*s)', mobility = 'diffusion' }]
        energy.length = { penalty = 10.0, target_ratio = 1.0 }
        time = { end = 5.0 }
        accuracy = { tolerance = 1e-6, nodes = 128 }
        output = { frames = 10, spacing = 'log', fields = ['energy-density'] }
        [energy.local]
        expression = '0.5*(kappa - 2*protein)^2 + (protein - 0.5)^2'
        ",
        "own energy",
    )?;
    let record = run(&scene, &mut Quiet)?;
    println!("    t        energy      most protein  largest energy per length");
    for frame in &record.frames {
        let largest = |values: &[f64]| values.iter().copied().fold(f64::MIN, f64::max);
        let (most, density) = (largest(&frame.density[0]), largest(&frame.fields[0]));
        println!("{:9.2e}  {:.8}  {most:.6}      {density:.6}", frame.time, frame.energy);
    }
    println!("{} after {} steps", record.stop_reason.message(), record.counters.steps);
    Ok(())
}
