//! Nodes that the program chooses: as many as the tolerance needs, where the solution needs them, while the run goes on.

use curveflow_tests::{scene, shipped};
use flow_core::run::tradeoff::{Ladder, tradeoff};
use flow_core::run::{Counters, Quiet, Record, Scene, Simulation, StopReason, run};

fn automatic(name: &str, changes: &[(&str, &str)]) -> Record {
    let mut all = vec![("accuracy.nodes", "auto")];
    all.extend_from_slice(changes);
    run(&shipped(name, &all), &mut Quiet).expect("a good scene")
}

/// Energy falls at every step but where nodes change, and there by no more than is recorded; mass and closure are kept.
fn check_laws(record: &Record, what: &str) {
    let (energy, nodes) = (&record.steps.energy, &record.steps.nodes);
    let rises: f64 = (1..energy.len())
        .filter(|step| nodes[*step] == nodes[step - 1])
        .map(|step| (energy[step] - energy[step - 1]).max(0.0))
        .sum();
    let last = record.frames.last().expect("a frame");
    let (first, scale) = (&record.frames[0], last.energy.abs());
    assert!(rises <= last.remap_error.abs() + 1e-4 * scale, "{what}: rises by {rises:.1e}");
    assert!(last.remap_error.abs() < 1e-3 * scale, "{what}: {:.1e}", last.remap_error);
    for (mass, initial) in last.mass.iter().zip(&first.mass) {
        assert!((mass / initial - 1.0).abs() < 1e-13, "{what}: mass {mass} from {initial}");
    }
    assert!(last.closure_defect < 1e-6 * last.length, "{what}: {:.1e}", last.closure_defect);
    assert_eq!(record.counters.unresolved_steps, 0, "{what}");
    assert!(record.frames.iter().all(|frame| frame.curvature.len() == record.nodes()), "{what}");
}

fn extremes(record: &Record) -> (u32, u32) {
    let nodes = &record.steps.nodes;
    (*nodes.iter().min().expect("steps"), *nodes.iter().max().expect("steps"))
}

#[test]
fn the_number_of_nodes_follows_the_solution() {
    let record = automatic("three_fold", &[]);
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    check_laws(&record, "three_fold");
    // Measured: 128 before the fronts form, 512 with them; the shipped scene ends at 5.604831 on 512 nodes throughout.
    let (least, most) = extremes(&record);
    assert!(least <= 192 && (384..=768).contains(&most), "{least} to {most}");
    let energy = record.frames.last().expect("a frame").energy;
    assert!((energy - 5.604_830_57).abs() < 1e-6, "{energy}");
}

#[test]
fn nodes_crowd_at_fronts_and_follow_them() {
    let record = automatic("three_fold_sharp", &[("flow.gauge", "graded")]);
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    check_laws(&record, "three_fold_sharp");
    // New nodes have new factorisations: one that was taken over solved nothing, and was made anew in the next step.
    let Counters { factorisations, steps, .. } = record.counters;
    assert!(5 * factorisations < 3 * steps, "{factorisations} in {steps} steps"); // 172 in 379
    // Equidistant nodes need 1,536 for 6.574317409.
    let (_, most) = extremes(&record);
    assert!(most <= 648, "{most}");
    let last = record.frames.last().expect("a frame");
    assert!((last.energy - 6.574_317_4).abs() < 1e-5, "{}", last.energy);
    let at = |f: fn(f64, f64) -> f64, start| last.metric.iter().copied().fold(start, f);
    assert!(at(f64::max, 0.0) > 4.0 * at(f64::min, f64::INFINITY), "the nodes crowd");
}

/// A solution that becomes smooth needs ever fewer nodes, down to the least, and no crowds.
#[test]
fn every_scene_runs_on_nodes_that_follow_it() {
    for (name, _) in Scene::shipped().iter().filter(|(name, _)| *name != "three_fold_sharp") {
        for tolerance in [1e-3, 1e-5] {
            let shown = tolerance.to_string();
            let [graded, uniform] = ["graded", "scaled-arc-length"]
                .map(|gauge| automatic(name, &[("flow.gauge", gauge), ("accuracy.tolerance", &shown)]));
            assert!(!matches!(graded.stop_reason, StopReason::Failed(_)), "{name}: {:?}", graded.stop_reason);
            let energy = |record: &Record| record.frames.last().expect("a frame").energy;
            let difference = (energy(&graded) / energy(&uniform) - 1.0).abs();
            assert!(difference < 10.0 * tolerance, "{name} at {shown}: {difference:.1e}");
        }
    }
}

/// Six fronts from the start, whatever ε.
fn fronts(epsilon: f64) -> Record {
    let text = format!(
        "
        curve = {{ shape = 'trillium' }}
        time.end = 0.003
        flow.gauge = 'graded'
        energy.length = {{ penalty = 3.0, target_ratio = 1.2 }}
        output.frames = 2
        [[density]]
        name = 'protein'
        initial = '0.55 + 0.35*(1 - 2/(1 + exp(16*cos(6*pi*s))))'
        mobility = 'diffusion'
        [energy.agents]
        density = 'protein'
        epsilon = {epsilon}
        delta = 0.2
        preferred_curvature = '1.3 - 2.0/0.76*(rho - 0.19)'
        low_density = '0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)'
        high_density = '0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)'
        "
    );
    run(&scene(&text), &mut Quiet).expect("a good scene")
}

#[test]
fn sharper_fronts_ask_for_few_nodes_more() {
    let (mut means, mut lasts) = (Vec::new(), Vec::new());
    for epsilon in [0.05, 0.02, 0.01, 0.005, 0.002] {
        let record = fronts(epsilon);
        assert_eq!(record.stop_reason, StopReason::EndTime, "{epsilon}");
        check_laws(&record, &format!("epsilon = {epsilon}"));
        let (mean, last) = (mean_nodes(&record), *record.steps.nodes.last().expect("steps"));
        println!(
            "epsilon = {epsilon}: {:?} nodes, {mean:.0} in the mean over the time, {last} at the end, {} steps",
            extremes(&record),
            record.counters.steps
        );
        means.push(mean);
        lasts.push(last);
    }
    // For fronts that are twenty-five times as sharp 1.90 to 1.97 times as many, as rounding has it.
    assert!(means.iter().all(|mean| *mean <= 2.0 * means[0]), "{means:?}");
    let (least, greatest) = (lasts.iter().min().expect("some"), lasts.iter().max().expect("some"));
    assert!(*greatest <= 2 * least, "{lasts:?}");
}

/// Nodes in the mean over the time of the run.
fn mean_nodes(record: &Record) -> f64 {
    let steps = record.steps.size.iter().zip(&record.steps.nodes);
    let sum: f64 = steps.map(|(size, nodes)| size * f64::from(*nodes)).sum();
    sum / record.steps.size.iter().sum::<f64>()
}

#[test]
fn the_tolerance_bounds_the_errors_of_time_and_space() {
    for gauge in ["scaled-arc-length", "graded"] {
        let changes = [("accuracy.nodes", "auto"), ("flow.gauge", gauge), ("time.end", "0.1")];
        let ladder = Ladder::new(&[1e-3, 1e-4, 1e-5], None).expect("a ladder");
        let measured = tradeoff(&shipped("three_fold", &changes), &ladder, &mut Quiet).expect("measured");
        let got: Vec<f64> =
            measured.rungs().map(|(tolerance, rung)| rung.largest_error() / tolerance).collect();
        println!("{gauge}: {got:.2?}");
        assert!(got.len() == 3 && got.iter().all(|part| (0.03..=10.0).contains(part)), "{gauge}: {got:?}");
    }
}

/// That of the state at hand is not the one of the step that ended with it.
#[test]
fn what_a_change_of_the_nodes_does_to_the_energy_is_recorded() {
    let switch = "[{ time = 0.002, gauge = 'co-moving' }, { time = 0.004, gauge = 'scaled-arc-length' }]";
    for (name, key, value) in [
        ("three_fold", "accuracy.nodes", "auto"),
        ("three_fold_sharp", "flow.gauge", "graded"),
        ("length_penalty", "flow.switch", switch),
    ] {
        let changes = [("accuracy.tolerance", "1e-2"), ("accuracy.nodes", "auto"), (key, value)];
        let mut simulation = Simulation::new(&shipped(name, &changes)).expect("a good scene");
        let (mut added, mut largest) = (0.0, 0.0_f64);
        while simulation.step(&mut Quiet) {
            let step = simulation.steps().energy.last().copied().expect("a step");
            let frame = simulation.frame();
            added += frame.energy - step;
            largest = largest.max((frame.energy - step).abs() / step.abs());
            assert!(
                (frame.remap_error - added).abs() <= 1e-12 * step.abs(),
                "{name}: {} {added}",
                frame.remap_error
            );
        }
        println!("{name}: {} changes, {largest:.1e}", simulation.counters().remaps);
        assert!(largest > 1e-10, "{name}: {largest:.1e}");
    }
}
