//! Waves that nothing damps.

use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, Finish, INTEGRALS, Problem, Stepper};

/// Waves of the frequencies 1, 2, …; holds γ.
struct Waves(f64);

/// Of them, the lowest has the amplitude 1, and all others have that of rounding.
const WAVES: usize = 40;
const ROUNDING: f64 = 1e-13;
const END: f64 = 30.0;

impl Problem for Waves {
    fn size(&self) -> usize {
        2 * WAVES
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        for (wave, (rate, y)) in rate.chunks_exact_mut(2).zip(y.chunks_exact(2)).enumerate() {
            let frequency = (wave + 1) as f64;
            (rate[0], rate[1]) = (frequency * y[1], -frequency * y[0]);
        }
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.rate(y, rate);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.rate(v, out);
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.0 = gamma;
        true
    }

    fn precondition(&mut self, r: &mut [f64]) {
        for (wave, r) in r.chunks_exact_mut(2).enumerate() {
            let turn = self.0 * (wave + 1) as f64;
            let scale = 1.0 / (1.0 + turn * turn);
            (r[0], r[1]) = (scale * (r[0] + turn * r[1]), scale * (r[1] - turn * r[0]));
        }
    }

    fn undamped_frequency(&self) -> f64 {
        WAVES as f64
    }

    fn finish(&mut self, _: f64, _: &mut [f64]) -> Finish {
        Finish::Good { energy: 1.0, integral_rates: [0.0; INTEGRALS] }
    }
}

/// The formulas of order 3 to 5 multiply such waves, that of order 5 by up to 1.37 a step.
#[test]
fn no_order_multiplies_waves() {
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut waves = Waves(0.0);
        let (mut y, mut counters) = ([ROUNDING; 2 * WAVES], Counters::default());
        y[0] = 1.0;
        let stepper = Bdf::new(&mut waves, &y, [0.0; INTEGRALS], tolerance, &mut counters);
        let options = AdaptiveOptions {
            end: END,
            most_steps: 100_000,
            energy_tolerance: 0.01 * tolerance,
            doubts_gradients: true,
        };
        let mut steps = Adaptive::new(stepper, options, 1.0, counters);
        let mut orders = [0_usize; 6];
        while steps.stepper().time() < END {
            steps.step(&mut waves).expect("a step");
            orders[steps.stepper().order()] += 1;
        }
        let largest = steps.stepper().state()[2..].iter().fold(0.0_f64, |most, y| most.max(y.abs()));
        println!("{tolerance:.0e}: {largest:.1e}, steps of the orders {orders:?}");
        assert!(largest < 0.01 * tolerance, "{tolerance:.0e}: {largest:.1e}");
    }
}
