//! Circles of kept length and area, and curves that are nearly circles.

use curveflow_tests::{assert_close, last, run, scene};
use flow_core::run::{Record, StopReason};

/// Bending pushes at a circle of kept length and area, or nearly a circle, unevenly, by a density that decays: the curve cannot go anywhere, or hardly.
/// A circle took 10,468 steps at 1e-5, where it moved to and fro within the rounding of its area.
#[test]
fn circles_of_kept_length_and_area_cost_no_steps() {
    for (axis, tolerances) in [
        (1.01, ["1e-3", "1e-5", "1e-6"]),
        (1.010_000_001, ["1e-3", "1e-5", "1e-6"]),
        (1.010_01, ["1e-4", "1e-5", "1e-6"]),
        (1.0101, ["1e-3", "1e-5", "1e-6"]),
    ] {
        let mut reference = None;
        for tolerance in tolerances.into_iter().rev() {
            let record = run(&scene(&format!(
                "
                curve = {{ shape = 'ellipse', semi_axes = [1.01, {axis:?}] }}
                density = [{{ name = 'a', initial = '0.6354 + 0.051*cos(8*pi*s)', mobility = 'exchange' }}]
                energy.local.expression = '0.297*a^2 + 0.0318*a_sigma^2'
                energy.bending.rigidity = 1.43
                energy.length = {{ penalty = 30.8, target_ratio = 1.28 }}
                flow.normal_mobility = 'incompressible-area-preserving'
                time = {{ end = 1.384, max_steps = 1000, stop_at_equilibrium = false }}
                accuracy.tolerance = {tolerance}
                "
            )));
            let steps = record.counters.steps;
            println!("{axis} at {tolerance}: {steps} steps, energy {:?}", last(&record).energy);
            assert_eq!(record.stop_reason, StopReason::EndTime, "{axis} at {tolerance}");
            assert!(steps < 100, "{axis} at {tolerance}: {steps} steps");
            assert_close(last(&record).energy, *reference.get_or_insert(last(&record).energy), 1e-4);
        }
    }
}

/// As on equidistant nodes: solves by a band, which leave as much of the curvature as they may, and an area put right in directions that are but
/// errors of the nodes bent the circle until it was held no more. It took 1006 steps at 1e-5, 14,248 at 1e-6, and failed at 1e-4.
#[test]
fn circles_of_kept_length_and_area_are_held_on_nodes_that_crowd_or_move() {
    let of_density = "energy.local.expression = '50*(p-0.1)^2*(p-0.9)^2 + 0.02*p_sigma^2'
                      energy.bending.rigidity = 1.0";
    let of_agents = "[energy.agents]
                     density = 'p'
                     epsilon = 0.05
                     delta = 0.2
                     preferred_curvature = '1.0'
                     low_density = '0.1'
                     high_density = '0.9'";
    for (energy, tolerances) in
        [(of_density, &["1e-6", "1e-5", "1e-4", "1e-3", "1e-2"][..]), (of_agents, &["1e-4", "1e-2"][..])]
    {
        let mut reference = None;
        for tolerance in tolerances {
            for gauge in ["graded", "co-moving", "scaled-arc-length"] {
                for solver in ["auto", "banded"] {
                    let case = format!("{gauge} at {tolerance}, {solver}");
                    let record = run(&scene(&format!(
                        "
                        curve = {{ shape = 'circle', radius = 1.0 }}
                        density = [{{ name = 'p', initial = '0.5 + 0.4*tanh(8*sin(2*pi*s))', mobility = 'diffusion' }}]
                        flow = {{ normal_mobility = 'incompressible-area-preserving', gauge = '{gauge}' }}
                        time = {{ end = 1000.0, max_steps = 1000 }}
                        accuracy = {{ tolerance = {tolerance}, linear_solver = '{solver}' }}
                        {energy}
                        "
                    )));
                    let (steps, energy) = (record.counters.steps, last(&record).energy);
                    println!("{case}: {steps} steps, off by {:.1e}, energy {energy:?}", deviation(&record));
                    assert_eq!(record.stop_reason, StopReason::Equilibrium, "{case}");
                    assert!(steps < 150, "{case}: {steps} steps");
                    assert!(deviation(&record) < 1e-9, "{case}: off a circle by {:e}", deviation(&record));
                    assert_close(energy, *reference.get_or_insert(energy), 1e-3);
                }
            }
        }
    }
}

/// The curve `curve` of kept length and area, pushed at by the density `density` that it carries along.
fn pushed(curve: &str, preferred_curvature: &str, density: &str, tolerance: &str) -> Record {
    let record = run(&scene(&format!(
        "
        curve = {{ {curve} }}
        density = [{{ name = 'a', initial = '{density}', mobility = 'none' }}]
        energy.bending = {{ rigidity = 1.0, preferred_curvature = '{preferred_curvature}', density = 'a' }}
        flow.normal_mobility = 'incompressible-area-preserving'
        time = {{ end = 20.0, stop_at_equilibrium = false }}
        accuracy.tolerance = {tolerance}
        "
    )));
    println!("{curve} at {tolerance}: {} steps, energy {:?}", record.counters.steps, last(&record).energy);
    record
}

/// Largest deviation of the curvature at the end from its mean of 1.
fn deviation(record: &Record) -> f64 {
    last(record).curvature.iter().fold(0.0, |most, kappa| f64::max(most, (kappa - 1.0).abs()))
}

/// One that is run through twice has the area of other curves of its length as well.
#[test]
fn a_circle_that_is_run_through_twice_is_not_held() {
    for tolerance in ["1e-2", "1e-4"] {
        let curve = "shape = 'parametric', turning_number = 2, x = 'cos(2*phi)', y = 'sin(2*phi)'";
        let record = pushed(curve, "2*rho", "0.6 + 0.3*cos(2*pi*s)", tolerance);
        assert_close(deviation(&record), 0.204, 0.02);
    }
}

/// What an ellipse has left of an area makes a far larger curvature in a high mode.
#[test]
fn an_ellipse_that_is_nearly_a_circle_takes_the_mode_of_its_force() {
    for tolerance in ["1e-2", "1e-4"] {
        let curve = "shape = 'polar', r = '1 + 0.0011*cos(2*phi)'";
        let record = pushed(curve, "0.2*rho", "0.6 + 0.2*cos(80*pi*s)", tolerance);
        assert_close(deviation(&record), 0.0429, 1e-3);
    }
}

/// Curves that are nearly circles, some held and some not, pushed at by a density that decays: the sphere about the circle on which they may move is as small as the
/// errors of steps. Where each state was held or not by itself, and only nearer to a circle, these failed.
#[test]
fn near_circles_on_either_side_of_the_hold_come_to_their_end() {
    for (amplitude, mode, gauge, tolerance) in [
        ("1e-8", 3, "scaled-arc-length", "1e-6"),
        ("3e-7", 5, "scaled-arc-length", "1e-5"),
        ("3e-7", 2, "co-moving", "1e-5"),
        ("1e-5", 5, "scaled-arc-length", "1e-3"),
        ("1e-5", 3, "co-moving", "1e-3"),
        ("3e-5", 5, "scaled-arc-length", "1e-3"),
        ("3e-5", 3, "scaled-arc-length", "1e-3"),
        ("1e-4", 2, "co-moving", "1e-3"),
    ] {
        let record = run(&scene(&format!(
            "
            curve = {{ shape = 'polar', r = '1 + {amplitude}*cos({mode}*phi)' }}
            density = [{{ name = 'a', initial = '1 + 0.3*cos(4*pi*s) + 0.1*cos(2*pi*s)', mobility = 'diffusion' }}]
            energy.bending.rigidity = 1.0
            energy.local.expression = '0.5*(a - kappa)^2 + 0.05*a_sigma^2'
            flow = {{ normal_mobility = 'incompressible-area-preserving', gauge = '{gauge}' }}
            time = {{ end = 10.0, max_steps = 1000, stop_at_equilibrium = false }}
            accuracy.tolerance = {tolerance}
            "
        )));
        let (steps, energy) = (record.counters.steps, last(&record).energy);
        println!("{amplitude}, {mode}, {gauge} at {tolerance}: {steps} steps, energy {energy:?}");
        assert_eq!(record.stop_reason, StopReason::EndTime, "{amplitude}, {mode}, {gauge} at {tolerance}");
        assert_close(energy, std::f64::consts::PI, 1e-6);
    }
}
