//! How long the parts of an evaluation take: a short replay at one state, after a run, so that the run itself has no clocks in
//! its kernels.

use std::time::Instant;

use super::{Descent, GradientFlow};
use crate::flow::energy_sum::TermCost;

/// Seconds of one part in one evaluation of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EvaluationCost {
    /// In [`GradientFlow::spectral_rate`].
    pub rate: f64,
    /// In [`GradientFlow::spectral_dissipation`].
    pub check: f64,
    /// In [`GradientFlow::spectral_linearise`] with [`GradientFlow::frozen_rate`].
    pub linearisation: f64,
    /// In [`GradientFlow::spectral_jacobian_product`].
    pub product: f64,
}

/// Seconds by part; what is left of an evaluation belongs to the flow map and to the transforms.
#[derive(Clone, Debug, PartialEq)]
pub struct PartCosts {
    /// All parts together.
    pub whole: EvaluationCost,
    /// Of each term, with the machinery that it alone needs, in their order.
    pub terms: Vec<EvaluationCost>,
    /// The normal mobility.
    pub normal_mobility: EvaluationCost,
    /// The mobilities of the densities, together.
    pub density_mobilities: EvaluationCost,
}

/// The least times count: the first round finds cold caches.
const FEWEST_ROUNDS: usize = 2;
const MOST_ROUNDS: usize = 20;

impl GradientFlow {
    /// Measures the parts at the spectral `state`, in rounds that end after `limit` seconds; at least two of them.
    ///
    /// The state evaluated last is then `state`; linearise anew before further products.
    pub fn part_costs(&mut self, state: &[f64], limit: f64) -> PartCosts {
        let mut terms = vec![TermCost::LARGEST; 1 + self.energy.names().count()];
        let (mut set, mut apply, mut density) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let mut idle = f64::INFINITY; // what the clock itself takes
        let (mut whole, mut scratch) = (EvaluationCost::LARGEST, vec![0.0; state.len()]);
        let clock = Instant::now();
        for round in 0..MOST_ROUNDS {
            if round >= FEWEST_ROUNDS && clock.elapsed().as_secs_f64() > limit {
                break;
            }
            idle = idle.min(seconds(|| ()));
            self.measure_whole(state, &mut scratch, &mut whole);
            // Before the terms: they leave another gradient behind.
            let Self { current, descent, energy, .. } = self;
            density = density.min(seconds(|| _ = descent.add_density_dissipation(&current.fields, 0.0)));
            // Where the mobility is not defined, that it finds so is all that it costs.
            set = set.min(seconds(|| descent.set_mobility(current)));
            let Descent { force, velocity, gradient, .. } = descent;
            apply = apply.min(seconds(|| current.drive(force, velocity)));
            energy.measure_terms(&current.fields, state, gradient, &mut terms);
        }
        let [set, apply, density] = [set, apply, density].map(|least| (least - idle).max(0.0));
        PartCosts {
            whole,
            terms: terms[1..].iter().map(|term| EvaluationCost::of_term(term.over(terms[0]))).collect(),
            normal_mobility: EvaluationCost {
                rate: set + apply,
                check: set + apply,
                linearisation: set + apply,
                product: apply,
            },
            // A rate has them in the dissipation as well.
            density_mobilities: EvaluationCost {
                rate: 2.0 * density,
                check: density,
                linearisation: density,
                product: density,
            },
        }
    }

    /// Lowers `whole` to what a round of evaluations takes; the last of them is that of a check.
    fn measure_whole(&mut self, state: &[f64], scratch: &mut [f64], whole: &mut EvaluationCost) {
        whole.linearisation = whole.linearisation.min(seconds(|| {
            self.spectral_linearise(state);
            self.frozen_rate(scratch);
        }));
        whole.product = whole.product.min(seconds(|| self.spectral_jacobian_product(state, scratch)));
        whole.rate = whole.rate.min(seconds(|| _ = self.spectral_rate(state, scratch)));
        whole.check = whole.check.min(seconds(|| _ = self.spectral_dissipation(state)));
    }
}

impl EvaluationCost {
    /// Before any measurement.
    const LARGEST: Self = Self {
        rate: f64::INFINITY,
        check: f64::INFINITY,
        linearisation: f64::INFINITY,
        product: f64::INFINITY,
    };

    fn of_term(cost: TermCost) -> Self {
        Self {
            rate: cost.gradient,
            check: cost.gradient,
            linearisation: cost.linearisation,
            product: cost.product,
        }
    }
}

fn seconds(call: impl FnOnce()) -> f64 {
    let clock = Instant::now();
    call();
    clock.elapsed().as_secs_f64()
}
