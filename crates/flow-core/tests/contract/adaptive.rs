//! The guards of the step loop, on a problem that a caller brings.

use flow_core::integrator::{
    Adaptive, AdaptiveOptions, Bdf, Counters, INTEGRALS, Integrals, Multistep, Stepper,
};

use crate::refusals::panics;
use crate::scalar::{Law, Scalar};

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

impl Law for Decay {
    fn rate(&self, y: f64) -> f64 {
        -y
    }

    fn slope(&self, _: f64) -> f64 {
        -1.0
    }

    fn word(&self, time: f64, y: f64) -> Word {
        if time > self.accepted + FAR { (self.spoilt)(word(y)) } else { word(y) }
    }

    fn accepted(&mut self, time: f64) {
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
        let mut problem = Scalar::new(Decay { spoilt, accepted: 0.0 });
        let (y, tolerance, mut counters) = ([2.0], 1e-4, Counters::default());
        let (energy, rates) = word(y[0]);
        let integrals = Integrals::new(0.0, [0.0; INTEGRALS], rates);
        let stepper = Multistep::starting(&mut problem, &y, integrals, tolerance, &mut counters);
        let options = AdaptiveOptions {
            end: 1.0,
            most_steps: 10_000,
            energy_tolerance: 0.01 * tolerance,
            doubts_gradients: false,
        };
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

/// ẏ = −y with the energy y², whose candidates tell five times their dissipation, and settle by going up.
#[derive(Default)]
struct Rough {
    settled: usize,
}

impl Law for Rough {
    fn rate(&self, y: f64) -> f64 {
        -y
    }

    fn slope(&self, _: f64) -> f64 {
        -1.0
    }

    fn word(&self, _: f64, y: f64) -> Word {
        (y * y, [10.0 * y * y, y, 0.0, 0.0])
    }

    fn settle(&mut self) -> Option<f64> {
        self.settled += 1;
        Some(0.5)
    }
}

#[test]
fn what_settles_for_the_worse_is_taken_back() {
    let (start, tolerance, mut counters) = (2.0, 1e-4, Counters::default());
    let mut problem = Scalar::new(Rough::default());
    let (energy, rates) = problem.law().word(0.0, start);
    let stepper = Bdf::new(&mut problem, &[start], rates, tolerance, &mut counters);
    let options =
        AdaptiveOptions { end: 1.0, most_steps: 10_000, energy_tolerance: 0.1, doubts_gradients: false };
    let mut integration = Adaptive::new(stepper, options, energy, counters);
    while integration.stepper().time() < options.end {
        integration.step(&mut problem).expect("a step");
    }
    let error = integration.stepper().state()[0] / (start * (-1.0_f64).exp()) - 1.0;
    assert!(problem.law().settled > 0 && error.abs() < 10.0 * tolerance, "{error:.1e}");
}

#[test]
fn a_start_that_no_step_could_serve_is_refused() {
    let start = |y: &[f64], tolerance: f64| {
        let (mut problem, y) = (Scalar::new(Rough::default()), y.to_vec());
        let rates = word(2.0).1;
        panics("must be positive and finite", || {
            Bdf::new(&mut problem, &y, rates, tolerance, &mut Counters::default());
        });
    };
    for tolerance in [f64::NAN, f64::INFINITY, 0.0, -1e-4] {
        start(&[2.0], tolerance);
    }
    let mut problem = Scalar::new(Rough::default());
    let integrals = || Integrals::new(0.0, [0.0; INTEGRALS], word(2.0).1);
    panics("length of the state", || {
        _ = Multistep::starting(&mut problem, &[2.0; 2], integrals(), 1e-4, &mut Counters::default());
    });
    let options =
        AdaptiveOptions { end: 1.0, most_steps: 1, energy_tolerance: 1e-6, doubts_gradients: false };
    for (message, options) in [
        ("energy tolerance", AdaptiveOptions { energy_tolerance: f64::NAN, ..options }),
        ("energy tolerance", AdaptiveOptions { energy_tolerance: -1.0, ..options }),
        ("end of an integration", AdaptiveOptions { end: f64::NAN, ..options }),
    ] {
        let mut counters = Counters::default();
        let stepper = Bdf::new(&mut problem, &[2.0], word(2.0).1, 1e-4, &mut counters);
        panics(message, || _ = Adaptive::new(stepper, options, 2.0, counters));
    }
}
