//! Runs that end where the curve comes into contact with itself.

use curveflow_tests::{assert_close, largest_rise, last, run, scene};
use flow_core::run::{Record, StopReason};

#[test]
fn a_run_stops_on_contact_if_the_scene_says_so() {
    let scene_text = |stop: bool| {
        format!(
            "
            curve = {{ shape = 'ellipse', semi_axes = [2.0, 0.6] }}
            energy.bending.rigidity = 0.05
            energy.length = {{ penalty = 100.0, target_ratio = 1.0 }}
            energy.area.pressure = -5.0
            flow.stop_on_contact = {stop}
            time = {{ end = 0.4, stop_at_equilibrium = false }}
            accuracy = {{ tolerance = 1e-5, nodes = 256 }}
            output.frames = 40
            "
        )
    };
    let stopped = run(&scene(&scene_text(true)));
    assert_eq!(stopped.stop_reason, StopReason::Contact);
    let contact = last(&stopped).time;
    let whole = run(&scene(&scene_text(false)));
    assert_eq!(whole.stop_reason, StopReason::EndTime);
    // Before the contact one is the other; the frame after it is the first one with crossings.
    let shared = stopped.frames.len() - 1;
    assert!(stopped.frames[..shared] == whole.frames[..shared] && shared > 5, "{shared} frames");
    assert!(stopped.frames.iter().all(|frame| frame.crossings == 0.0));
    let next = &whole.frames[shared];
    assert!(contact < next.time && next.time < contact + 0.0101 && next.crossings > 0.0, "{contact}");
}

/// A neck that closes by adhesion, with frames around the contact.
fn neck(tolerance: &str, change: &str) -> Record {
    run(&scene(&format!(
        "
        curve = {{ shape = 'parametric', x = '2*cos(phi)', y = 'sin(phi)*(0.15 + 0.85*cos(phi)^2)' }}
        energy.bending.rigidity = 0.05
        energy.adhesion.kernel = '-0.5*exp(-q/0.05)'
        energy.length = {{ penalty = 10.0, target_ratio = 1.0 }}
        flow.stop_on_contact = true
        time.end = 5.0
        accuracy.tolerance = {tolerance}
        output.times = [0.05, 0.1, 0.12, 0.14, 0.145, 0.15, 0.155, 0.16]
        {change}
        "
    )))
}

#[test]
fn the_time_of_a_contact_is_that_of_the_flow_and_not_of_the_end_of_its_step() {
    let methods =
        ["", "accuracy.linear_solver = 'banded'", "flow.gauge = 'graded'", "flow.gauge = 'co-moving'"];
    for method in methods {
        for (tolerance, error) in [("1e-3", 0.01), ("1e-5", 3e-4), ("1e-8", 1e-5)] {
            let record = neck(tolerance, method);
            assert_eq!(record.stop_reason, StopReason::Contact);
            let end = last(&record);
            println!("{method} {tolerance}: {}", end.time);
            assert!((end.time / 0.141_940_5 - 1.0).abs() < error, "{method}, {tolerance}: {}", end.time);
            assert!(record.frames.iter().all(|frame| frame.crossings == 0.0), "{method}, {tolerance}");
            // That at the start, four of the schedule, and it.
            assert_eq!(record.frames.len(), 6, "{method}, {tolerance}");
            let (energy, time) = (record.steps.energy.last(), record.steps.time.last());
            assert!(time == Some(&end.time), "{method}, {tolerance}: {time:?}");
            assert_close(*energy.expect("steps"), end.energy, 1e-12);
            assert!(largest_rise(&record) < 1e-12, "{method}, {tolerance}");
        }
    }
    let balance = last(&neck("1e-5", "")).energy_balance;
    assert!(balance.abs() < 1e-5, "{balance:e}");
}

/// Lobes that overlap at the start may do so; those that touch are in contact at once.
#[test]
fn a_contact_counts_from_the_crossings_at_the_start() {
    let pressed = |y: &str| {
        run(&scene(&format!(
            "
            curve = {{ shape = 'parametric', x = '2*cos(phi)', y = '{y}' }}
            energy = {{ bending.rigidity = 0.05, length = {{ penalty = 100.0, target_ratio = 1.0 }}, area.pressure = -5.0 }}
            flow.stop_on_contact = true
            time = {{ end = 0.4, stop_at_equilibrium = false }}
            accuracy = {{ tolerance = 1e-5, nodes = 256 }}
            "
        )))
    };
    let touching = pressed("sin(phi)*cos(phi)^2");
    assert_eq!(touching.stop_reason, StopReason::Contact);
    assert_eq!((touching.frames.len(), touching.counters.steps), (2, 1));
    assert!(last(&touching).time > 0.0 && last(&touching).time < 1e-8, "{:e}", last(&touching).time);
    assert_eq!(pressed("sin(phi)*(cos(phi)^2 - 0.05)").stop_reason, StopReason::EndTime);
}

#[test]
fn a_curve_that_comes_free_of_itself_is_not_in_contact() {
    let record = run(&scene(
        "
        curve = { shape = 'parametric', x = '2*cos(phi)', y = 'sin(phi)*(cos(phi)^2 - 0.05)' }
        energy.bending.rigidity = 1.0
        energy.length = { penalty = 100.0, target_ratio = 1.0 }
        flow.stop_on_contact = true
        time = { end = 0.2, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-5, nodes = 128 }
        ",
    ));
    assert_eq!((record.frames[0].crossings, last(&record).crossings), (2.0, 0.0));
    assert_eq!(record.stop_reason, StopReason::EndTime);
}
