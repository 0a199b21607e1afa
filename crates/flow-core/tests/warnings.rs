//! What is said of runs that came to their end and are doubtful all the same.

use flow_core::integrator::Activity;
use flow_core::output::page::card;
use flow_core::run::{Limit, Quiet, Scene, Seconds, Spending, WhySlow, run, warnings};

fn shipped(name: &str, changes: &[(&str, &str)]) -> Scene {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    let changes: Vec<_> = changes.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
    Scene::parse_with(text, name, &changes).expect("valid")
}

#[test]
fn good_runs_are_not_doubted() {
    for (name, _) in Scene::shipped() {
        for tolerance in ["1e-2", "1e-4"] {
            let record =
                run(&shipped(name, &[("accuracy.tolerance", tolerance)]), &mut Quiet).expect("a state");
            assert!(warnings(&record).is_empty(), "{name} at {tolerance}: {:?}", warnings(&record));
        }
    }
}

#[test]
fn energy_that_was_neither_kept_nor_dissipated_is_told() {
    let mut record = run(&shipped("circle", &[("accuracy.tolerance", "1e-4")]), &mut Quiet).expect("a state");
    let energy = record.frames[0].energy;
    let last = record.frames.last_mut().expect("a frame");
    last.remap_error = 0.1 * energy;
    last.energy_balance = last.remap_error + 1e-3 * energy;
    let told = warnings(&record);
    assert!(matches!(&told[..], [one] if one.contains("apart by 1.0e-3 of the energy")), "{told:?}");
}

/// Steps that are each in balance, and a curve that wrinkles all the same.
#[test]
fn a_run_that_loses_its_balance_bit_by_bit_is_told() {
    let text = "
        curve = { shape = 'figure-eight', size = 0.5 }
        density = [{ name = 'a', initial = 0.92, mobility = 'exchange' }]
        energy.agents = { density = 'a', epsilon = 0.02, delta = 0.13, preferred_curvature = '0.13 - 2*(rho - 0.2)', \
                          low_density = 0.15, high_density = 0.9 }
        time = { end = 0.0167, stop_at_equilibrium = false }
        accuracy.tolerance = 3e-4
        ";
    let record = run(&Scene::parse(text, "eight").expect("valid"), &mut Quiet).expect("a state");
    assert!(warnings(&record).iter().any(|told| told.contains("take a smaller accuracy.tolerance")));
    let tighter = run(&Scene::parse(&text.replace("3e-4", "1e-5"), "eight").expect("valid"), &mut Quiet)
        .expect("a state");
    assert!(warnings(&tighter).is_empty());
}

/// They are looked at now and then, and each look speaks for the steps since the one before.
#[test]
fn fixed_nodes_that_are_too_few_all_along_are_told() {
    let record =
        run(&shipped("three_fold_sharp", &[("accuracy.nodes", "256")]), &mut Quiet).expect("a state");
    let told = warnings(&record);
    assert!(
        told.iter().any(|told| told.contains("were not resolved by their nodes")),
        "{:?}",
        record.counters
    );
}

/// Fewer steps, or cheaper ones, would make it worse.
#[test]
fn a_doubtful_run_is_to_be_mended_before_it_is_made_quicker() {
    let coarse = run(
        &shipped("three_fold_sharp", &[("accuracy.nodes", "64"), ("accuracy.tolerance", "1e-3")]),
        &mut Quiet,
    )
    .expect("a state");
    let told = warnings(&coarse);
    assert_eq!(told.len(), 1, "{told:?}");
    let mut timed = coarse.clone();
    // What the clocks say is another matter.
    timed.seconds = Seconds::default();
    timed.seconds[Spending::Step(Activity::Solve)] = 1.0;
    for (terms, limit) in [(vec![0.1, 0.1], Limit::Accuracy), (vec![0.9, 0.1], Limit::Term)] {
        timed.seconds.evaluations.terms = terms;
        let why = WhySlow::of(&timed);
        assert_eq!(why.limit, limit, "{why}");
        assert!(why.advice.starts_with("first more accuracy.nodes"), "{}", why.advice);
        assert!(told[0].contains("take more accuracy.nodes"), "{}", told[0]);
    }
    let good = run(&shipped("circle", &[]), &mut Quiet).expect("a state");
    assert!(!WhySlow::of(&good).advice.contains("doubtful"));
    let steps = coarse.counters.steps;
    assert!(card(&coarse).contains(&format!("warning: {steps} of the {steps} steps")));
    assert!(!card(&good).contains("warning"));
}
