//! Symmetries of the flow: motions of the plane, reflection, choice of the first node, scale.

use flow_core::expression::Expression;
use flow_core::geometry::Layout;
use flow_core::geometry::shapes::Shape;
use flow_core::operators::DerivativeFamily;
use proptest::prelude::*;

use crate::config;
use crate::states::{any_blob, any_nodes};
use crate::terms::{Term, every_flow, flow};
use crate::vectors::{distance, largest};

/// What the flow makes of a state: energy, velocity, rates.
struct Outcome {
    energy: f64,
    velocity: Vec<f64>,
    rate: Vec<f64>,
}

fn outcome(term: Term, family: DerivativeFamily, layout: Layout, y: &[f64]) -> Outcome {
    let mut flow = flow(term, family, layout);
    let mut rate = vec![0.0; y.len()];
    let energy = flow.rate(y, &mut rate).energy;
    Outcome { energy, velocity: flow.normal_velocity().to_vec(), rate }
}

/// The state with node `i` taken from node `from(i)`.
fn relabelled(layout: Layout, y: &[f64], from: impl Fn(usize) -> usize) -> Vec<f64> {
    let mut out = y.to_vec();
    for field in 0..layout.fields() {
        let range = layout.field(field);
        for (i, value) in out[range.clone()].iter_mut().enumerate() {
            *value = y[range.start + from(i)];
        }
    }
    out
}

/// Rounding of the transforms, magnified by up to six derivatives at 96 nodes: (πn/|Γ|)⁶ ε, relative to the
/// largest value, where smooth forces hide it least.
const ROUNDING: f64 = 1e-8;
/// Rounding of a sum of n local terms.
const ENERGY_ROUNDING: f64 = 1e-13;

proptest! {
    #![proptest_config(config(12))]

    #[test]
    fn the_flow_commutes_with_relabelling(blob in any_blob(), nodes in any_nodes(), shift in 1_usize..30) {
        let shifted = move |i: usize| (i + shift) % nodes;
        let reflected = move |i: usize| (nodes - i) % nodes;
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let layout = state.layout;
            let plain = outcome(term, family, layout, &state.y);
            let relabellings: [(&str, &dyn Fn(usize) -> usize); 2] =
                [("shift", &shifted), ("reflection", &reflected)];
            for (name, from) in relabellings {
                let moved = outcome(term, family, layout, &relabelled(layout, &state.y, from));
                let expected = relabelled(layout, &plain.rate, from);
                let velocity = relabelled(Layout::new(nodes, 0), &[plain.velocity.as_slice(), &[0.0]].concat(), from);
                let difference = (plain.energy - moved.energy).abs();
                prop_assert!(difference <= ENERGY_ROUNDING * plain.energy.abs(), "{name}: {term:?}, {family:?}: {difference:.1e}");
                let error = distance(&moved.velocity, &velocity) / largest(&velocity);
                prop_assert!(error <= ROUNDING, "{name}: {term:?}, {family:?}: velocity {error:.1e}");
                let error = distance(&moved.rate, &expected) / largest(&expected);
                prop_assert!(error <= ROUNDING, "{name}: {term:?}, {family:?}: rate {error:.1e}");
            }
        }
    }

    #[test]
    fn energy_and_velocity_do_not_see_where_the_curve_lies(
        blob in any_blob(), nodes in any_nodes(), angle in 0.0_f64..6.0, x in -3.0_f64..3.0, y in -3.0_f64..3.0,
    ) {
        let r = blob.radius_formula();
        let [c, s] = [f64::cos(angle), f64::sin(angle)];
        let parse = |text: String| Expression::parse(&text, &["phi"]).expect("a formula");
        let moved = Shape::Parametric {
            x: parse(format!("({r})*(({c:?})*cos(phi) - ({s:?})*sin(phi)) + ({x:?})")),
            y: parse(format!("({r})*(({s:?})*cos(phi) + ({c:?})*sin(phi)) + ({y:?})")),
        };
        for (term, family) in every_flow() {
            let state = blob.state(nodes, term.densities());
            let moved = blob.state_on(&moved, nodes, term.densities());
            let plain = outcome(term, family, state.layout, &state.y);
            let moved = outcome(term, family, state.layout, &moved.y);
            // The resampling of the moved curve rounds its curvatures at 1e-14.
            let difference = (plain.energy - moved.energy).abs();
            prop_assert!(difference <= 1e-12 * plain.energy.abs(), "{term:?}, {family:?}: {difference:.1e}");
            let error = distance(&plain.velocity, &moved.velocity) / largest(&plain.velocity);
            prop_assert!(error <= 100.0 * ROUNDING, "{term:?}, {family:?}: velocity {error:.1e}");
        }
    }

    #[test]
    fn bending_scales_with_the_inverse_of_the_size(
        blob in any_blob(), nodes in any_nodes(), factor in 0.1_f64..10.0,
    ) {
        for family in DerivativeFamily::ALL {
            let state = blob.state(nodes, 0);
            let layout = state.layout;
            let mut scaled = state.y.clone();
            // K = κ|Γ| has no dimension.
            scaled[layout.length_index()] *= factor;
            let (plain, scaled) = (
                outcome(Term::Bending, family, layout, &state.y),
                outcome(Term::Bending, family, layout, &scaled),
            );
            prop_assert!((scaled.energy * factor - plain.energy).abs() <= ENERGY_ROUNDING * plain.energy);
            let by_cube: Vec<f64> = scaled.velocity.iter().map(|v| v * factor.powi(3)).collect();
            let error = distance(&by_cube, &plain.velocity) / largest(&plain.velocity);
            prop_assert!(error <= ROUNDING, "{family:?}: {error:.1e}");
        }
    }

    #[test]
    fn areas_scale_with_the_square_of_the_size(
        blob in any_blob(), nodes in any_nodes(), factor in 0.1_f64..10.0,
    ) {
        for family in DerivativeFamily::ALL {
            let state = blob.state(nodes, 0);
            let layout = state.layout;
            let mut scaled = state.y.clone();
            scaled[layout.length_index()] *= factor;
            let plain = outcome(Term::Pressure, family, layout, &state.y);
            let scaled = outcome(Term::Pressure, family, layout, &scaled);
            let expected = plain.energy * factor.powi(2);
            prop_assert!((scaled.energy - expected).abs() <= ENERGY_ROUNDING * expected.abs());
            let error = distance(&scaled.velocity, &plain.velocity) / largest(&plain.velocity);
            prop_assert!(error <= ROUNDING, "{family:?}: {error:.1e}");
        }
    }
}
