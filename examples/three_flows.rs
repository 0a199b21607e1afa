//! The shipped scenes that hold the length of the trillium in three ways, compared at their end.
//!
//! `cargo run --release -p curveflow-examples --bin three_flows`

use std::error::Error;
use std::f64::consts::PI;

use flow_core::run::{Quiet, Scene, run};

fn main() -> Result<(), Box<dyn Error>> {
    println!("scene              length/initial  length²/4πA  bending energy  steps");
    for name in ["length_penalty", "membrane_penalty", "incompressible"] {
        let (_, text) =
            Scene::shipped().iter().find(|(shipped, _)| *shipped == name).ok_or("no such scene")?;
        let record = run(&Scene::parse(text, name)?, &mut Quiet)?;
        let [first, .., last] = record.frames.as_slice() else { return Err("no frames".into()) };
        println!(
            "{name:17}  {:14.6}  {:11.5}  {:14.5}  {:5}",
            last.length / first.length,
            last.length * last.length / (4.0 * PI * last.area),
            last.energy_terms[0],
            record.counters.steps
        );
    }
    Ok(())
}
