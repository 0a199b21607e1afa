//! Steps in stretched time: what settles by a power of the time, on a problem that a caller brings.

use flow_core::integrator::{
    Adaptive, AdaptiveOptions, Bdf, Counters, INTEGRALS, Integrals, Multistep, Stepper,
};

use crate::scalar::{Law, Scalar};

/// ẏ = −y³ from y = 1000, the gradient flow of y⁴/4: y = (2t + 10⁻⁶)^{−1/2}.
struct Power;

const START: f64 = 1e3;
const END: f64 = 1e4;

fn exact(time: f64) -> f64 {
    (2.0 * time + START.powi(-2)).powf(-0.5)
}

fn rates(y: f64) -> [f64; INTEGRALS] {
    [y.powi(6), y, 0.0, 0.0]
}

impl Law for Power {
    fn rate(&self, y: f64) -> f64 {
        -y.powi(3)
    }

    fn slope(&self, y: f64) -> f64 {
        -3.0 * y.powi(2)
    }

    fn word(&self, _: f64, y: f64) -> (f64, [f64; INTEGRALS]) {
        (0.25 * y.powi(4), rates(y))
    }

    fn is_exponential(&self) -> bool {
        true
    }
}

/// Steps over ten decades of the time since the singularity that the solution comes from; the largest relative errors at their
/// ends, and between them in what a frame would show.
fn steps_and_errors<S: Stepper>(
    tolerance: f64,
    start: impl FnOnce(&mut Scalar<Power>, &mut Counters) -> S,
) -> (u64, [f64; 2]) {
    let (mut problem, mut counters) = (Scalar::new(Power), Counters::default());
    let stepper = start(&mut problem, &mut counters);
    let options = AdaptiveOptions {
        end: END,
        most_steps: 10_000,
        energy_tolerance: 0.01 * tolerance,
        doubts_gradients: false,
    };
    let mut integration = Adaptive::new(stepper, options, 0.25 * START.powi(4), counters);
    let mut errors = [0.0_f64; 2];
    let error = |y: f64, time: f64| (y / exact(time) - 1.0).abs();
    while integration.stepper().time() < END {
        let before = integration.stepper().time();
        let report = integration.step(&mut problem).expect("a step");
        errors[0] = errors[0].max(error(integration.stepper().state()[0], report.time));
        for part in [0.0, 0.3, 0.7, 1.0] {
            let (time, mut y) = (before + part * (report.time - before), [0.0]);
            integration.stepper().interpolate(time, &mut y);
            errors[1] = errors[1].max(error(y[0], time));
        }
    }
    (integration.counters().steps, errors)
}

/// By the time itself there are three times as many implicit steps, and more than twice as many exponential ones.
#[test]
fn what_settles_by_a_power_of_the_time_takes_few_steps() {
    for (tolerance, most_implicit, most_exponential) in [(1e-4, 200, 160), (1e-7, 500, 350)] {
        let implicit = steps_and_errors(tolerance, |problem, counters| {
            Bdf::new(problem, &[START], rates(START), tolerance, counters)
        });
        let exponential = steps_and_errors(tolerance, |problem, counters| {
            let integrals = Integrals::new(0.0, [0.0; INTEGRALS], rates(START));
            Multistep::starting(problem, &[START], integrals, tolerance, counters)
        });
        for ((steps, errors), most) in [(implicit, most_implicit), (exponential, most_exponential)] {
            assert!(steps < most, "{tolerance:e}: {steps} steps");
            let [at_ends, between] = errors;
            assert!(at_ends < 100.0 * tolerance, "{tolerance:e}: {at_ends:.1e}");
            assert!(
                between < 1.2 * at_ends,
                "{tolerance:e}: {between:.1e} between, {at_ends:.1e} at the ends"
            );
        }
    }
}
