//! Extreme scenes: each succeeds with its laws intact and an honest error, or stops with the error that says why.

use curveflow_tests::extremes::sweep::{Random, draw};
use curveflow_tests::extremes::{Case, Size, data, parameters, round_off, scaling, times};
use curveflow_tests::last;

/// Error of a run over its tolerance: errors of a few hundred steps add up, and a transient may carry them on.
const HONEST: f64 = 30.0;

fn check(cases: &[Case]) {
    for case in cases.iter().filter(|case| case.size == Size::Small) {
        let (outcome, error) = case.measure_with_error();
        println!("{}: {:?}, {} steps, error {error:?}", case.name, outcome.end, outcome.steps());
        assert_eq!(outcome.end, case.expected, "{}: {}", case.name, outcome.message);
        assert_eq!(outcome.broken_law(), None, "{}", case.name);
        let bound = HONEST * case.scene().accuracy.tolerance;
        assert!(error.is_none_or(|error| error <= bound), "{}: error {error:?} > {bound:.1e}", case.name);
    }
}

#[test]
fn widths_of_fronts() {
    check(&parameters::epsilon());
}

#[test]
fn stiffness_of_the_curvature() {
    check(&parameters::delta());
}

#[test]
fn penalties_on_the_length() {
    check(&parameters::penalty());
}

#[test]
fn penalties_on_the_area() {
    check(&parameters::area_penalty());
}

#[test]
fn compressibilities_of_a_membrane() {
    check(&parameters::membrane());
}

#[test]
fn numbers_of_nodes() {
    check(&parameters::nodes());
}

#[test]
fn tolerances() {
    check(&parameters::tolerance());
}

#[test]
fn end_times() {
    check(&times::ends());
}

#[test]
fn flows_that_end() {
    check(&times::singular());
}

#[test]
fn flows_that_are_ill_posed() {
    check(&times::ill_posed());
}

#[test]
fn peaks_and_necks() {
    check(&data::curves());
}

#[test]
fn fronts_masses_and_ranges() {
    check(&data::densities());
}

/// |Γ| is held within c/β, c the force of the rest of the energy, for no more than twice the steps.
#[test]
fn a_stiff_penalty_holds_the_length_at_no_cost() {
    let cases = parameters::penalty();
    let measured = |name: &str| {
        let case = cases.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
        let outcome = case.measure();
        let frames = outcome.record.as_ref().map(|record| (record.frames[0].length, last(record).length));
        let (before, after) = frames.unwrap_or_default();
        (outcome.steps(), (after - before).abs())
    };
    for scene in ["bending", "agents"] {
        let ((soft_steps, soft), (stiff_steps, stiff)) =
            (measured(&format!("{scene}, β = 3.0")), measured(&format!("{scene}, β = 1e8")));
        println!("{scene}: {soft_steps} and {stiff_steps} steps, {soft:.1e} and {stiff:.1e}");
        assert!(stiff <= 100.0 / 1e8, "{scene}: {stiff:.1e}");
        assert!(stiff_steps <= 2 * soft_steps, "{scene}: {stiff_steps} steps, {soft_steps} with β = 3");
    }
}

/// A stiff penalty on the area is one direction that is stiff: steps do not become as short as its time.
#[test]
fn a_stiff_penalty_holds_the_area_at_little_cost() {
    for case in parameters::area_penalty() {
        let outcome = case.measure();
        let few = if case.name.starts_with("identity") { 200 } else { 500 };
        assert!(outcome.steps() <= few, "{}: {} steps", case.name, outcome.steps());
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let unit = scaling::at(1.0);
    for radius in scaling::RADII {
        let scaled = scaling::at(radius);
        let distance = scaling::distance(&scaled, radius, &unit);
        println!("R = {radius:e}: {} steps, distance {distance:.1e}", scaled.counters.steps);
        assert!(distance <= 1e-9, "R = {radius:e}: {distance:.1e}");
        assert_eq!(scaled.counters.steps, unit.counters.steps, "R = {radius:e}");
    }
}

#[test]
fn rounding_leaves_the_velocity_of_a_circle() {
    for family in round_off::FAMILIES {
        let error = round_off::error(65536, family);
        assert!(error <= 1e-5, "{family}: {error:.1e}");
    }
}

#[test]
fn random_scenes_end_well() {
    let mut random = Random::new(1);
    for index in 0..40 {
        let (text, outcome) = draw(&mut random);
        println!("{index}: {:?}, {} steps", outcome.end, outcome.steps());
        assert_eq!(outcome.broken_law(), None, "{:?}: {}\n{text}", outcome.end, outcome.message);
    }
}
