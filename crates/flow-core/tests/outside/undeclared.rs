//! A term that adds parts of its energy and does not say so: they would be left out.

use std::panic::{AssertUnwindSafe, catch_unwind};

use flow_core::energies::{EnergyTerm, Fields, Jet, Order, ShapeFields};
use flow_core::run::{Scene, SetupError, Simulation};

use crate::uniform::start;

/// ∫κ² dσ, ∫`κ_s²` dσ or minus the area, as `part` says, without a word.
#[derive(Debug)]
struct Silent {
    part: usize,
}

const PARTS: [&str; 3] = ["has_density", "has_slope_density", "has_shape_energy"];

fn add_square(jet: &mut Jet, field: usize, values: &[f64]) {
    let order = jet.order();
    for (i, value) in values.iter().enumerate() {
        jet.value_mut()[i] += value * value;
        jet.first_mut(field)[i] += 2.0 * value;
        if order >= Order::Hessian {
            jet.second_mut(field, field)[i] += 2.0;
        }
    }
}

impl EnergyTerm for Silent {
    fn name(&self) -> &'static str {
        "silent"
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        if self.part == 0 {
            add_square(jet, 0, fields.get(0));
        }
    }

    fn add_slope_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        if self.part == 1 {
            let slopes = fields.count() / 2;
            add_square(jet, slopes, fields.get(slopes));
        }
    }

    fn add_shape_energy(&mut self, shape: &ShapeFields, _: Order, _: &mut ShapeFields) -> f64 {
        let [[x, y], [cos, sin]] = [shape.positions(), shape.tangents()];
        let area: f64 = (0..x.len()).map(|i| x[i] * sin[i] - y[i] * cos[i]).sum();
        if self.part == 2 { -area } else { 0.0 }
    }
}

fn scene() -> Scene {
    let text = "
        curve = { shape = 'circle', radius = 1.0 }
        energy.length.tension = 0.2
        time.end = 0.1
        accuracy = { nodes = 32 }
    ";
    Scene::parse(text, "a test").expect("a scene")
}

#[test]
fn a_run_with_such_a_term_does_not_start() {
    for (part, name) in PARTS.into_iter().enumerate() {
        let error = Simulation::with_terms(&scene(), move |_| vec![Box::new(Silent { part })]).err();
        let Some(SetupError::Undeclared(found)) = error else { panic!("{name}: {error:?}") };
        assert_eq!((found.term, found.flag), ("silent", name));
    }
    assert!(Simulation::with_terms(&scene(), |_| vec![Box::new(Silent { part: 3 })]).is_ok());
}

#[test]
fn its_derivatives_cannot_be_checked() {
    for (part, name) in PARTS.into_iter().enumerate() {
        let (mut flow, state) = start(vec![Box::new(Silent { part })], [1.4, 0.9], 96);
        let mut y = vec![0.0; flow.layout().len()];
        flow.decode(&state, &mut y);
        let panic = catch_unwind(AssertUnwindSafe(|| flow.check_derivatives(&y))).expect_err("a panic");
        let message = panic.downcast_ref::<String>().expect("a message");
        assert!(message.contains("`silent`") && message.contains(name), "{message}");
    }
}
