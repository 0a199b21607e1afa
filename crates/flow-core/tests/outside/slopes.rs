//! A term of slopes under a derivative whose flux points are the nodes.

use flow_core::energies::{EnergyTerm, Fields, Jet, Length, Order};
use flow_core::flow::LinearSolver;

use crate::uniform::{run, start};

/// ∫((κ² − 2.25)² + 0.005 `κ_s²`) dσ: two wells, and fronts between them.
#[derive(Debug)]
struct Wells;

impl EnergyTerm for Wells {
    fn name(&self) -> &'static str {
        "wells"
    }

    fn has_slope_density(&self) -> bool {
        true
    }

    fn add_slope_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let order = jet.order();
        for (i, (kappa, slope)) in fields.get(0).iter().zip(fields.get(1)).enumerate() {
            let well = kappa * kappa - 2.25;
            jet.value_mut()[i] += well * well + 0.005 * slope * slope;
            jet.first_mut(0)[i] += 4.0 * kappa * well;
            jet.first_mut(1)[i] += 0.01 * slope;
            if order >= Order::Hessian {
                jet.second_mut(0, 0)[i] += 12.0 * kappa * kappa - 9.0;
                jet.second_mut(1, 1)[i] += 0.01;
            }
        }
    }
}

/// At the nodes the sawtooth would have no slope, and grow to a third of the largest mode.
#[test]
fn the_sawtooth_costs_what_its_slope_does() {
    let terms: Vec<Box<dyn EnergyTerm>> =
        vec![Box::new(Wells), Box::new(Length::Penalty { penalty: 10.0, target: 7.5 })];
    let start = start(terms, [1.4, 0.9], 128);
    let end = run(start, LinearSolver::Auto, 1e-6, 1.0, 5000);
    assert!(end.error.is_none(), "{:?}", end.error);
    let amplitudes: Vec<f64> = end.state[..130].chunks_exact(2).map(|c| c[0].hypot(c[1])).collect();
    let (last, largest) = (amplitudes[64], amplitudes[1..].iter().copied().fold(0.0, f64::max));
    println!("{} steps, energy {}, last mode {last:.2e} of {largest:.2}", end.counters.steps, end.energy);
    assert!(last < 0.02 * largest, "{last} of {largest}");
}
