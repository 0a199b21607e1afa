//! The measured order of convergence of every method on an ellipse that bends towards a circle.

use curveflow_benches::measure::Method;
use curveflow_benches::rivals::Shared;
use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, ErrorNorm, Finish, Problem, Stepper};
use flow_core::run::{Scene, Setup};

const SCENE: &str = "
curve = { shape = 'ellipse', semi_axes = [1.2, 0.9] }
[energy]
bending = { rigidity = 1.0 }
length = { penalty = 1.0, target_ratio = 1.0 }
[time]
end = 1.0
[accuracy]
nodes = 16
linear_solver = 'dense'
";
const END: f64 = 0.02;

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
    let options = AdaptiveOptions { end: END, most_steps: 100_000 };
    let mut integration = Adaptive::new(stepper, options, energy, counters);
    while integration.stepper().time() < END {
        integration.step(&mut problem).unwrap();
    }
    integration.stepper().state().to_vec()
}

/// The end state, and the norm of the error estimate of the first step.
fn constant_steps(method: Method, steps: usize) -> (Vec<f64>, f64) {
    let (mut problem, mut y, _) = setup();
    let mut formula = method.formula(&problem).unwrap();
    let mut norm = ErrorNorm::new(&problem);
    norm.rescale(&problem, &y);
    let (mut next, mut error) = (y.clone(), y.clone());
    let mut counters = Counters::default();
    let size = END / steps as f64;
    let mut first = 0.0;
    for step in 0..steps {
        let solved =
            formula.advance(&mut problem, &norm, &y, size, 1e-10, &mut next, &mut error, &mut counters);
        assert!(solved, "{} at step {step} of {steps}", method.name());
        if step == 0 {
            first = norm.norm(&error);
        }
        assert!(matches!(problem.finish((step + 1) as f64 * size, &mut next), Finish::Good { .. }));
        formula.accepted();
        y.copy_from_slice(&next);
    }
    (y, first)
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
    for method in Method::ALL.into_iter().filter(|method| *method != Method::Bdf) {
        let order = method.formula(&setup().0).unwrap().order() as f64;
        let runs = [50, 100, 200].map(|steps| constant_steps(method, steps));
        let errors = runs.each_ref().map(|(y, _)| distance(y, &exact));
        let measured = (errors[1] / errors[2]).log2();
        eprintln!("{}: errors {errors:?}, order {measured:.2}", method.name());
        eprintln!("   estimates {:?}", runs.each_ref().map(|(_, first)| *first));
        assert!((measured - order).abs() < 0.4, "{}: {errors:?}, order {measured}", method.name());
    }
}

#[test]
fn the_error_of_bdf_follows_its_tolerance() {
    let exact = bdf(1e-11);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let error = distance(&bdf(tolerance), &exact);
        eprintln!("tolerance {tolerance:.0e}: error {error:.1e}");
        assert!(error < 20.0 * tolerance && error > 0.01 * tolerance, "{tolerance}: {error}");
    }
}
