//! A term that means nothing beyond a curvature.

use flow_core::energies::{EnergyTerm, Fields, Jet, Order, TermFault};

use crate::uniform::start;

/// −c∫ln(1 − (κ/K)²) dσ, for |κ| < K.
#[derive(Debug)]
pub struct Barrier {
    pub strength: f64,
    pub most: f64,
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
        let beyond = |(node, kappa): (usize, &f64)| {
            (kappa.abs() >= self.most).then_some(TermFault::OutOfRange {
                term: "barrier",
                quantity: "κ",
                node,
                value: *kappa,
                least: -self.most,
                most: self.most,
            })
        };
        fields.get(0).iter().enumerate().find_map(beyond)
    }
}

#[test]
fn a_state_beyond_the_range_of_a_term_is_refused() {
    let barrier = |most| -> Vec<Box<dyn EnergyTerm>> { vec![Box::new(Barrier { strength: 0.1, most })] };
    for (most, refused) in [(10.0, false), (1.2, true)] {
        // Curvatures up to 1.4/0.9² = 1.73.
        let (mut flow, state) = start(barrier(most), [1.4, 0.9], 96);
        flow.spectral_gradient(&state);
        let fault = flow.fault();
        assert_eq!(fault.is_some(), refused, "{fault:?}");
        let message = fault.map_or_else(String::new, |fault| fault.to_string());
        assert!(!refused || message.contains("must lie between -1.200000e0 and 1.200000e0"), "{message}");
    }
}
