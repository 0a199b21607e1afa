//! The guards of the step loop, on a problem that a caller brings.

use std::ops::Range;

use flow_core::integrator::{
    Adaptive, AdaptiveOptions, Counters, Finish, INTEGRALS, Integrals, Multistep, Problem, Stepper,
};

/// What a candidate says beside its state: energy and rates of the integrals.
type Word = (f64, [f64; INTEGRALS]);

/// Spoils it.
type Spoil = fn(Word) -> Word;

/// ẏ = −y with the energy y²/2, where candidates farther than [`FAR`] from the last state say `spoilt` of themselves.
struct Decay {
    spoilt: Spoil,
    accepted: f64,
}

const FAR: f64 = 0.01;

fn word(y: f64) -> Word {
    (0.5 * y * y, [y * y, y, 0.0, 0.0])
}

impl Problem for Decay {
    fn size(&self) -> usize {
        1
    }

    // One block.
    #[allow(clippy::single_range_in_vec_init)]
    fn blocks(&self) -> Vec<Range<usize>> {
        vec![0..1]
    }

    fn block_floor(&self, _: usize, _: &[f64]) -> f64 {
        f64::MIN_POSITIVE
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        rate[0] = -y[0];
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.rate(y, rate);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        out[0] = -v[0];
    }

    fn factorise(&mut self, _: f64) -> bool {
        true
    }

    fn precondition(&mut self, _: &mut [f64]) {}

    fn weigh(&self, _: &mut [f64]) {}

    fn unweigh(&self, _: &mut [f64]) {}

    fn krylov_feedback(&mut self, _: usize) -> bool {
        false
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        let far = time > self.accepted + FAR;
        let (energy, integral_rates) = if far { (self.spoilt)(word(y[0])) } else { word(y[0]) };
        Finish::Good { energy, dissipation: integral_rates[0], integral_rates }
    }

    fn accepted(&mut self, time: f64, _: [f64; INTEGRALS]) {
        self.accepted = time;
    }
}

#[test]
fn a_step_whose_balance_is_no_number_is_not_taken() {
    let spoilt: [(&str, Spoil); 4] = [
        ("energy", |(_, rates)| (f64::NAN, rates)),
        ("dissipation", |(energy, [_, b, c, d])| (energy, [f64::NAN, b, c, d])),
        ("infinite dissipation", |(energy, [_, b, c, d])| (energy, [f64::INFINITY, b, c, d])),
        ("another integral", |(energy, [a, _, c, d])| (energy, [a, f64::NAN, c, d])),
    ];
    for (name, spoilt) in spoilt {
        let mut problem = Decay { spoilt, accepted: 0.0 };
        let (y, tolerance, mut counters) = ([2.0], 1e-4, Counters::default());
        let (energy, rates) = word(y[0]);
        let integrals = Integrals::new(0.0, [0.0; INTEGRALS], rates);
        let stepper = Multistep::starting(&mut problem, &y, integrals, tolerance, &mut counters);
        let options = AdaptiveOptions { end: 1.0, most_steps: 10_000, energy_tolerance: 0.01 * tolerance };
        let mut integration = Adaptive::new(stepper, options, energy, counters);
        while integration.stepper().time() < options.end {
            let report = integration.step(&mut problem).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(report.size <= 1.01 * FAR, "{name}: a step of {:.1e} was taken", report.size);
            assert!(report.energy.is_finite(), "{name}");
        }
        assert!(integration.counters().rejections.not_finite > 0, "{name}: no candidate was spoilt");
        let [dissipated, moved, ..] = integration.integrals();
        let end = integration.stepper().state()[0];
        assert!((end / (2.0 * f64::exp(-1.0)) - 1.0).abs() < 1e-2, "{name}: y = {end}");
        assert!((energy - integration.energy() - dissipated).abs() < tolerance * energy, "{name}");
        assert!((2.0 - end - moved).abs() < tolerance, "{name}: ∫y dt = {moved}, y = {end}");
    }
}
