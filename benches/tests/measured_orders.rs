//! The measured order of convergence of every method on an ellipse that bends towards a circle.

#![allow(clippy::unwrap_used)] // helpers of tests

use curveflow_benches::measure::Method;
use curveflow_benches::rivals::Shared;
use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, ErrorNorm, Finish, Problem, Stepper};
use flow_core::run::{Scene, Setup};

const SCENE: &str = "
curve = { shape = 'ellipse', semi_axes = [1.15, 0.9] }
[energy]
bending = { rigidity = 1.0 }
length = { penalty = 1.0, target_ratio = 0.92 }
[time]
end = 1.0
[accuracy]
nodes = 8 # few modes: none so stiff that the order is reduced
linear_solver = 'dense'
";
const END: f64 = 0.1;

fn setup() -> (Shared, Vec<f64>, Finish) {
    let Setup { mut membrane, mut state, .. } = Setup::new(&Scene::parse(SCENE, "ellipse").unwrap()).unwrap();
    let finish = membrane.finish(0.0, &mut state);
    (Shared::new(membrane), state, finish)
}

fn bdf(tolerance: f64) -> Vec<f64> {
    let (mut problem, y, finish) = setup();
    let Finish::Good { energy, integral_rates, .. } = finish else { panic!() };
    let mut counters = Counters::default();
    let stepper = Bdf::new(&mut problem, &y, integral_rates, tolerance, &mut counters);
    let options = AdaptiveOptions {
        end: END,
        most_steps: 100_000,
        energy_tolerance: tolerance,
        doubts_gradients: false,
    };
    let mut integration = Adaptive::new(stepper, options, energy, counters);
    while integration.stepper().time() < END {
        integration.step(&mut problem).unwrap();
    }
    integration.stepper().state().to_vec()
}

fn constant_steps(method: Method, steps: usize) -> Vec<f64> {
    let (mut problem, mut y, _) = setup();
    let mut formula = method.formula(&problem).unwrap();
    let mut norm = ErrorNorm::new(&problem);
    norm.rescale(&problem, &y);
    let (mut next, mut error) = (y.clone(), y.clone());
    let mut counters = Counters::default();
    let size = END / steps as f64;
    // Newton's method, with its lagged linear part, does not reach rounding.
    let goal = if method == Method::Esdirk { 2e-11 } else { 1e-12 };
    for step in 0..steps {
        let solved =
            formula.advance(&mut problem, &norm, &y, size, goal, &mut next, &mut error, &mut counters);
        assert!(solved, "{} at step {step} of {steps}", method.name());
        assert!(matches!(problem.finish((step + 1) as f64 * size, &mut next), Finish::Good { .. }));
        formula.accepted();
        y.copy_from_slice(&next);
    }
    y
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let (problem, _, _) = setup();
    let mut norm = ErrorNorm::new(&problem);
    norm.rescale(&problem, b);
    let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    norm.norm(&difference)
}

#[test]
fn one_step_methods_converge_with_their_order() {
    let exact = bdf(1e-11);
    for method in Method::ALL {
        let Some(formula) = method.formula(&setup().0) else { continue };
        let order = formula.order() as f64;
        let runs = [20, 40, 80].map(|steps| constant_steps(method, steps));
        let errors = runs.each_ref().map(|y| distance(y, &exact));
        let measured = (errors[1] / errors[2]).log2();
        assert!((measured - order).abs() < 0.4, "{}: {errors:?}, order {measured}", method.name());
    }
}

#[test]
fn the_error_of_bdf_follows_its_tolerance() {
    let exact = bdf(1e-11);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let error = distance(&bdf(tolerance), &exact);
        assert!(error < 20.0 * tolerance && error > 0.01 * tolerance, "{tolerance}: {error}");
    }
}
