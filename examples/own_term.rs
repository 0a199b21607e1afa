//! A term of the energy that no scene can say, in a whole run: a membrane that cannot be bent beyond a curvature.
//!
//! A term says its density with the first and second derivatives; the library does the rest.
//! `cargo run --release -p curveflow-examples --bin own_term`

use std::error::Error;

use flow_core::energies::{EnergyTerm, Fields, Jet, Order, TermFault};
use flow_core::run::{Quiet, Scene, Setup, Simulation};

/// −c∫ln(1 − (κ/K)²) dσ, for |κ| < K.
#[derive(Debug)]
struct Barrier {
    strength: f64,
    most: f64,
}

impl EnergyTerm for Barrier {
    fn name(&self) -> &'static str {
        "barrier"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let order = jet.order();
        for (i, kappa) in fields.get(0).iter().enumerate() {
            let (x, c) = (kappa / self.most, self.strength);
            let room = 1.0 - x * x;
            jet.value_mut()[i] -= c * room.ln();
            jet.first_mut(0)[i] += 2.0 * c * x / room / self.most;
            if order >= Order::Hessian {
                jet.second_mut(0, 0)[i] += 2.0 * c * (1.0 + x * x) / (room * room) / self.most.powi(2);
            }
        }
    }

    fn fault(&self, fields: Fields<'_>) -> Option<TermFault> {
        let node = fields.get(0).iter().position(|kappa| kappa.abs() >= self.most)?;
        let (term, quantity, value) = ("barrier", "κ", fields.get(0)[node]);
        Some(TermFault::OutOfRange { term, quantity, node, value, least: -self.most, most: self.most })
    }
}

/// The terms beside those of the scene; called again where the run takes other nodes.
fn own_terms(_nodes: usize) -> Vec<Box<dyn EnergyTerm>> {
    vec![Box::new(Barrier { strength: 0.5, most: 2.5 })]
}

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::parse(
        "
        curve = { shape = 'ellipse', semi_axes = [1.5, 1.0] }
        energy.length = { penalty = 10.0, target_ratio = 1.0 }
        energy.area = { penalty = 20.0, target_ratio = 0.8 }
        time = { end = 5.0 }
        accuracy = { tolerance = 1e-6 }
        output = { frames = 8, spacing = 'log' }
        ",
        "own term",
    )?;

    // Derivatives must be exact; this tells.
    let mut setup = Setup::with_terms(&scene, own_terms)?;
    let flow = setup.membrane.flow();
    let mut state = vec![0.0; flow.layout().len()];
    flow.decode(&setup.state, &mut state);
    for errors in flow.check_derivatives(&state) {
        println!(
            "{:8} gradient {:.0e}, second derivative {:.0e}",
            errors.term, errors.gradient, errors.second_derivative
        );
    }

    let mut simulation = Simulation::with_terms(&scene, own_terms)?;
    simulation.run_until(f64::INFINITY, u64::MAX, &mut Quiet);
    let record = simulation.into_record();
    println!("    t        energy      largest curvature");
    for frame in &record.frames {
        let largest = frame.curvature.iter().copied().fold(f64::MIN, f64::max);
        println!("{:9.2e}  {:.8}  {largest:.6}", frame.time, frame.energy);
    }
    println!("{} after {} steps", record.stop_reason.message(), record.counters.steps);
    Ok(())
}
