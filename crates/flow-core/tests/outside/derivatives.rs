//! What becomes of a term whose derivatives are not those of its energy, or who does not say what it has.

use flow_core::energies::{Bending, EnergyTerm, Fields, Jet, Length, Order, ShapeFields};
use flow_core::flow::{DerivativeErrors, LinearSolver};
use flow_core::integrator::IntegrationError;
use flow_core::run::{Quiet, Scene, Simulation, StopReason, warnings};

use crate::uniform::{Terms, run, start};

/// ∫(0.3κ⁴/4 + κ²/2) dσ, with its derivatives times a factor each.
#[derive(Debug)]
struct Quartic {
    first: f64,
    second: f64,
}

impl EnergyTerm for Quartic {
    fn name(&self) -> &'static str {
        "quartic"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let order = jet.order();
        for (i, kappa) in fields.get(0).iter().enumerate() {
            jet.value_mut()[i] += 0.075 * kappa.powi(4) + 0.5 * kappa * kappa;
            jet.first_mut(0)[i] += self.first * (0.3 * kappa.powi(3) + kappa);
            if order >= Order::Hessian {
                jet.second_mut(0, 0)[i] += self.second * (0.9 * kappa * kappa + 1.0);
            }
        }
    }
}

fn quartic(first: f64, second: f64) -> Terms {
    vec![Box::new(Length::Penalty { penalty: 5.0, target: 7.0 }), Box::new(Quartic { first, second })]
}

/// ∫x³ dσ: a field that pulls at the curve from outside.
#[derive(Debug)]
struct Field;

impl EnergyTerm for Field {
    fn name(&self) -> &'static str {
        "field"
    }

    fn has_shape_energy(&self) -> bool {
        true
    }

    fn add_shape_energy(&mut self, shape: &ShapeFields, _: Order, out: &mut ShapeFields) -> f64 {
        let x = &shape.position[0];
        let mean = x.iter().map(|x| x.powi(3)).sum::<f64>() / x.len() as f64;
        for (out, x) in out.position[0].iter_mut().zip(x) {
            *out += 3.0 * shape.length * x * x;
        }
        out.length += mean;
        shape.length * mean
    }
}

fn errors(terms: Terms) -> Vec<DerivativeErrors> {
    let (mut flow, state) = start(terms, [1.4, 0.9], 96);
    let mut y = vec![0.0; flow.layout().len()];
    flow.decode(&state, &mut y);
    flow.check_derivatives(&y)
}

#[test]
fn wrong_derivatives_are_found_and_measured() {
    let [length, right] = errors(quartic(1.0, 1.0))[..] else { panic!("one for each term") };
    assert_eq!((length.term, right.term), ("length", "quartic"));
    assert!(length.are_small() && right.are_small(), "{length:?}, {right:?}");
    for wrong in [1.001, 1.1, 0.5, -1.0] {
        let [length, quartic] = errors(quartic(wrong, wrong))[..] else { panic!("one for each term") };
        assert!(length.are_small() && !quartic.are_small());
        // The derivative by the length at fixed turning holds the density itself, so that its parts are off by different factors.
        let off = quartic.gradient * wrong.abs().max(1.0) / (wrong - 1.0).abs();
        assert!(off > 0.5, "{wrong}: {quartic:?}");
    }
    for (wrong, least) in [(0.0, 0.5), (1.01, 1e-3)] {
        let [_, quartic] = errors(quartic(1.0, wrong))[..] else { panic!("one for each term") };
        assert!(quartic.gradient < DerivativeErrors::LARGEST, "{quartic:?}");
        assert!(quartic.second_derivative > least, "{quartic:?}");
    }
}

#[test]
fn a_force_from_outside_is_told() {
    let [field] = errors(vec![Box::new(Field)])[..] else { panic!("one term") };
    assert!(field.gradient < DerivativeErrors::LARGEST && field.net_force > 0.1, "{field:?}");
}

/// What is missing of the balance does not fall with the steps: the run says so, whatever ends it.
#[test]
fn a_wrong_gradient_is_named_when_a_run_ends() {
    let right = run(start(quartic(1.0, 1.0), [1.4, 0.9], 96), LinearSolver::Auto, 1e-6, 1.0, 500);
    assert!(right.error.is_none(), "{:?}", right.error);
    // −dE/D = ⟨∇E, 𝓚g⟩/⟨g, 𝓚g⟩ is 1/factor for g = factor ∇E, which this is but for its part by the length.
    for factor in [1.001, 1.01, 2.0, -1.0] {
        let terms: Terms = vec![Box::new(Quartic { first: factor, second: factor })];
        let end = run(start(terms, [1.4, 0.9], 96), LinearSolver::Auto, 1e-6, 1.0, 300);
        println!("{factor}: t = {:.1e}, {}", end.time, end.error.map_or_else(String::new, |e| e.to_string()));
        let Some(IntegrationError::OpenBalance { percent, .. }) = end.error else {
            panic!("{factor}: {:?}", end.error)
        };
        assert!((0.01 * percent * factor - 1.0).abs() < 0.02, "{factor}: {percent}");
    }
}

/// A right one is not, however few steps a run may take.
#[test]
fn a_right_gradient_is_not_named() {
    for most in [1, 2, 3, 5, 10, 20, 40] {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let start = start(quartic(1.0, 1.0), [1.4, 0.9], 96);
            let end = run(start, LinearSolver::Auto, tolerance, 100.0, most);
            let error = end.error.map(|error| error.to_string());
            assert!(
                error.as_ref().is_none_or(|error| error.contains("is used up")),
                "{most}, {tolerance:.0e}: {error:?}"
            );
        }
    }
}

/// −(c/4)∫κ⁴ dσ, with its exact derivatives: with bending, short waves grow where 3cκ² is more than the rigidity.
#[derive(Debug)]
struct Concave(f64);

impl EnergyTerm for Concave {
    fn name(&self) -> &'static str {
        "concave"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let order = jet.order();
        for (i, kappa) in fields.get(0).iter().enumerate() {
            jet.value_mut()[i] -= 0.25 * self.0 * kappa.powi(4);
            jet.first_mut(0)[i] -= self.0 * kappa.powi(3);
            if order >= Order::Hessian {
                jet.second_mut(0, 0)[i] -= 3.0 * self.0 * kappa * kappa;
            }
        }
    }
}

/// Its steps shrink as those of a wrong one do, and near the end no difference along the flow agrees with the gradient.
#[test]
fn a_right_gradient_of_an_ill_posed_flow_is_not_named() {
    for strength in [0.2, 0.5, 1.0, 5.0] {
        for nodes in [64, 96, 128] {
            let penalty = Length::Penalty { penalty: 10.0, target: 7.5 };
            let terms: Terms =
                vec![Box::new(penalty), Box::new(Bending::new(1.0)), Box::new(Concave(strength))];
            let end = run(start(terms, [1.5, 1.0], nodes), LinearSolver::Auto, 1e-5, 0.2, 3000);
            let Some(error) = end.error else { panic!("{strength}, {nodes}: no end") };
            let is_named = matches!(error, IntegrationError::OpenBalance { .. });
            assert!(!is_named, "{strength}, {nodes} nodes: {error}");
        }
    }
}

/// Where steps are long enough, a run with a wrong one gets to its end.
#[test]
fn a_wrong_gradient_is_in_the_warnings_of_a_run_that_ends() {
    let text = "
        curve = { shape = 'ellipse', semi_axes = [1.4, 0.9] }
        energy.length = { penalty = 5.0, target_ratio = 1.0 }
        time = { end = 0.2, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-2, nodes = 96 }
    ";
    let scene = Scene::parse(text, "a test").expect("a scene");
    for (factor, doubted) in [(1.0, false), (1.2, true)] {
        let wrong = move |_| -> Terms { vec![Box::new(Quartic { first: factor, second: factor })] };
        let mut simulation = Simulation::with_terms(&scene, wrong).expect("a start");
        simulation.run_until(f64::INFINITY, 2000, &mut Quiet);
        let record = simulation.into_record();
        assert_eq!(record.stop_reason, StopReason::EndTime, "{factor}");
        let told = warnings(&record).join(" ");
        let names = told.contains("`quartic`") && told.contains("check_derivatives");
        assert_eq!((names, told.is_empty()), (doubted, !doubted), "{factor}: {told}");
    }
}
