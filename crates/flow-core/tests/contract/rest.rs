//! Steps in which a state at rest is held, and states that move and are not, on problems that a caller brings.

use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, INTEGRALS, Rejections, Stepper};

use crate::scalar::{Law, Scalar};

const START: f64 = 2.0;
const END: f64 = 1.0;
const TOLERANCE: f64 = 1e-4;

fn started<L: Law>(problem: &mut Scalar<L>, end: f64) -> Adaptive<Bdf> {
    let mut counters = Counters::default();
    let (energy, rates) = problem.law().word(0.0, START);
    let stepper = Bdf::new(problem, &[START], rates, TOLERANCE, &mut counters);
    let options = AdaptiveOptions {
        end,
        most_steps: 10_000,
        energy_tolerance: 0.01 * TOLERANCE,
        doubts_gradients: false,
    };
    Adaptive::new(stepper, options, energy, counters)
}

/// Energies above the last one by more than this part of it have risen.
const ROUNDING: f64 = 1e-13;

/// ẏ = −y with the energy 1 + cy²/2, which falls by little more than its rounding in a step of [`FAR`]; candidates farther ahead seem to
/// be above the last state by one and a half times the rounding.
struct Faint {
    accepted: f64,
}

const FAINT: f64 = 2e-11;
const FAR: f64 = 0.01;

impl Faint {
    fn energy(y: f64) -> f64 {
        1.0 + 0.5 * FAINT * y * y
    }
}

impl Law for Faint {
    fn rate(&self, y: f64) -> f64 {
        -y
    }

    fn slope(&self, _: f64) -> f64 {
        -1.0
    }

    fn word(&self, time: f64, y: f64) -> (f64, [f64; INTEGRALS]) {
        let seeming = Self::energy(START * (-self.accepted).exp()) + 1.5 * ROUNDING;
        let energy = if time > self.accepted + FAR { seeming } else { Self::energy(y) };
        (energy, [FAINT * y * y, 0.0, 0.0, 0.0])
    }

    fn accepted(&mut self, time: f64) {
        self.accepted = time;
    }

    fn rests_with_its_energy(&self) -> bool {
        true
    }
}

/// Its dissipation tells: it would lose more than the rounding.
#[test]
fn a_state_that_moves_is_not_held_for_the_rounding_of_its_energy() {
    let mut problem = Scalar::new(Faint { accepted: 0.0 });
    let mut integration = started(&mut problem, END);
    while integration.stepper().time() < END {
        integration.step(&mut problem).expect("a step");
    }
    assert!(integration.counters().rejections.energy_rise > 0, "no candidate seemed to rise");
    let y = integration.stepper().state()[0];
    assert!((y / (START * (-END).exp()) - 1.0).abs() < 1e-2, "y = {y}");
}

/// A state that stays, at an energy that the candidates after [`QUIET`] miss by more than its rounding.
#[derive(Default)]
struct Resting {
    accepted: Vec<f64>,
}

const QUIET: f64 = 10.0;

impl Law for Resting {
    fn rate(&self, _: f64) -> f64 {
        0.0
    }

    fn slope(&self, _: f64) -> f64 {
        0.0
    }

    fn word(&self, time: f64, _: f64) -> (f64, [f64; INTEGRALS]) {
        (if time > QUIET { 1.0 + 3.0 * ROUNDING } else { 1.0 }, [0.0; INTEGRALS])
    }

    fn accepted(&mut self, time: f64) {
        self.accepted.push(time);
    }

    fn rests_with_its_energy(&self) -> bool {
        true
    }
}

#[test]
fn steps_that_hold_a_state_are_told_and_counted_as_others_are() {
    let mut problem = Scalar::new(Resting::default());
    let mut integration = started(&mut problem, 100.0 * QUIET);
    // A rate of zero has no time scale: the first step is limited by the end, and the watch needs several.
    integration.set_end(1e-3 * QUIET);
    let (mut times, mut rejected) = (Vec::new(), Rejections::default());
    while integration.stepper().time() < 100.0 * QUIET {
        let time = integration.stepper().time();
        if time > 0.0 {
            integration.set_end(2.0 * time);
        }
        let report = integration.step(&mut problem).expect("a step");
        times.push(report.time);
        rejected.energy_rise += report.rejections.energy_rise;
        assert_eq!((report.energy, integration.stepper().state()[0]), (1.0, START), "t = {}", report.time);
    }
    assert!(rejected.energy_rise > 3, "{rejected:?}");
    assert_eq!(integration.counters().rejections, rejected);
    assert_eq!(integration.counters().steps, times.len() as u64);
    assert_eq!(problem.law().accepted, times);
}

/// ẏ = −y with the energy y²/2.
struct Decay;

impl Law for Decay {
    fn rate(&self, y: f64) -> f64 {
        -y
    }

    fn slope(&self, _: f64) -> f64 {
        -1.0
    }

    fn word(&self, _: f64, y: f64) -> (f64, [f64; INTEGRALS]) {
        (0.5 * y * y, [y * y, 0.0, 0.0, 0.0])
    }
}

/// Where less than two steps are left they are made equal.
#[test]
fn the_last_step_before_the_end_is_no_sliver() {
    for place in 0..40 {
        let end = END + 0.03 * f64::from(place);
        let mut problem = Scalar::new(Decay);
        let mut integration = started(&mut problem, end);
        let mut sizes = Vec::new();
        while integration.stepper().time() < end {
            sizes.push(integration.step(&mut problem).expect("a step").size);
        }
        let [.., before, last] = sizes[..] else { panic!("two steps") };
        assert!(last > 0.4 * before, "to {end}: {last:.1e} after {before:.1e}");
    }
}
