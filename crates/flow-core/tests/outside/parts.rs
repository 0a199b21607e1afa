//! An energy and two mobilities that the library does not have.

use flow_core::energies::{EnergyTerm, Fields, Jet, Order};
use flow_core::flow::{CurveFields, DensityMobility, Exchange, MobilityError, NormalMobility};
use flow_core::geometry::Complex64;

/// (b/4)∫κ⁴(1 + ρ²) dσ.
#[derive(Debug)]
pub struct Quartic(pub f64);

impl EnergyTerm for Quartic {
    fn name(&self) -> &'static str {
        "quartic"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let order = jet.order();
        for i in 0..fields.nodes() {
            let (kappa, rho) = (fields.get(0)[i], fields.get(1)[i]);
            let (cube, mass) = (self.0 * kappa.powi(3), 1.0 + rho * rho);
            jet.value_mut()[i] += 0.25 * cube * kappa * mass;
            jet.first_mut(0)[i] += cube * mass;
            jet.first_mut(1)[i] += 0.5 * cube * kappa * rho;
            if order >= Order::Hessian {
                jet.second_mut(0, 0)[i] += 3.0 * self.0 * kappa.powi(2) * mass;
                jet.second_mut(0, 1)[i] += 2.0 * cube * rho;
                jet.second_mut(1, 1)[i] += 0.5 * cube * kappa;
            }
        }
    }
}

/// V = f/(1 + κ²): bent pieces move slowly.
#[derive(Clone, Debug, Default)]
pub struct Drag {
    mean: f64,
}

impl NormalMobility for Drag {
    fn set(&mut self, at: &CurveFields) -> Result<(), MobilityError> {
        let mobility: Vec<f64> = at.at_nodes(0).iter().map(|kappa| 1.0 / (1.0 + kappa * kappa)).collect();
        self.mean = at.mean(&mobility);
        Ok(())
    }

    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        for ((v, f), kappa) in velocity.iter_mut().zip(force).zip(at.at_nodes(0)) {
            *v = f / (1.0 + kappa * kappa);
        }
    }

    fn symbol(&self, _: f64) -> f64 {
        self.mean
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(self.clone())
    }
}

/// 𝓖 = c Id, the exchange at another speed.
#[derive(Debug)]
pub struct SlowExchange {
    pub speed: f64,
    pub exchange: Exchange,
}

impl DensityMobility for SlowExchange {
    fn apply(&mut self, at: &CurveFields, potential: &[Complex64], out: &mut [Complex64]) {
        self.exchange.apply(at, potential, out);
        for value in out {
            *value *= self.speed;
        }
    }

    fn symbol(&self, _: f64, _: f64) -> f64 {
        self.speed
    }

    fn order(&self) -> usize {
        0
    }

    fn three_points(&self, _: &CurveFields, _: usize, _: usize) -> [f64; 3] {
        [0.0, self.speed, 0.0]
    }

    fn conserves_mass(&self) -> bool {
        false
    }
}
