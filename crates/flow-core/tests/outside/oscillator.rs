//! A problem that is no gradient flow.

use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, Finish, INTEGRALS, Problem, Stepper};

/// y″ = −y, which tells a constant energy.
struct Oscillator;

impl Problem for Oscillator {
    fn size(&self) -> usize {
        2
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        (rate[0], rate[1]) = (y[1], -y[0]);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.rate(y, rate);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.rate(v, out);
    }

    fn factorise(&mut self, _: f64) -> bool {
        true
    }

    fn precondition(&mut self, _: &mut [f64]) {}

    fn finish(&mut self, _: f64, _: &mut [f64]) -> Finish {
        Finish::Good { energy: 1.0, integral_rates: [0.0; INTEGRALS] }
    }
}

/// An energy that stays the same does not tell that the state does: with the steps held that fail once it has stayed so while the time
/// doubled, this end was off by 1.8.
#[test]
fn a_constant_energy_holds_no_state() {
    for (tolerance, end) in [(1e-4, 40.0), (1e-7, 40.0)] {
        let (mut y, mut counters) = ([1.0, 0.0], Counters::default());
        let Finish::Good { energy, integral_rates, .. } = Oscillator.finish(0.0, &mut y) else {
            panic!("a start that is finite");
        };
        let stepper = Bdf::new(&mut Oscillator, &y, integral_rates, tolerance, &mut counters);
        let options = AdaptiveOptions {
            end,
            most_steps: 100_000,
            energy_tolerance: 0.01 * tolerance,
            doubts_gradients: true,
        };
        let mut steps = Adaptive::new(stepper, options, energy, counters);
        while steps.stepper().time() < end {
            steps.step(&mut Oscillator).expect("a step");
        }
        let y = steps.stepper().state();
        let error = (y[0] - end.cos()).hypot(y[1] + end.sin());
        println!("{tolerance:.0e}: error {error:.1e} after {} steps", steps.counters().steps);
        assert!(error < 1e3 * tolerance, "{tolerance:.0e}: {error:.1e}");
    }
}
