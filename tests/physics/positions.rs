//! Laws of the energies that depend on where the curve lies: area and adhesion.

use std::f64::consts::{PI, TAU};

use curveflow_tests::physics::fields::Interpolant;
use curveflow_tests::{assert_close, bisection, largest_rise, last, run, scene, shipped};
use flow_core::run::StopReason;

#[test]
fn pressure_inflates_a_circle_at_a_constant_speed() {
    let pressure = 0.7;
    let record = run(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = 1.0 }}
        energy.area.pressure = {pressure:?}
        time = {{ end = 2.0, stop_at_equilibrium = false }}
        accuracy = {{ tolerance = 1e-8, nodes = 64 }}
        output.frames = 20
        "
    )));
    // E = −pA falls at the rate p∫V dσ = ∫V² dσ, so V = p everywhere.
    for frame in &record.frames {
        let radius = 1.0 + pressure * frame.time;
        assert_close(frame.length, TAU * radius, 1e-7);
        assert_close(frame.energy, -pressure * PI * radius * radius, 1e-7);
        assert_close(frame.normal_velocity[0], pressure, 1e-9);
    }
}

#[test]
fn pressure_and_tension_move_a_circle_by_their_difference() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.5 }
        energy.area.pressure = 1.0
        energy.length.tension = 1.0
        time = { end = 1.0, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-8, nodes = 64 }
        ",
    ));
    // R′ = 1 − 1/R: R + ln(R − 1) = R₀ + ln(R₀ − 1) + t.
    let start = 1.5 + 0.5_f64.ln();
    for frame in &record.frames {
        let radius = bisection([1.1, 4.0], |r| r + (r - 1.0).ln() - start - frame.time);
        // Near R = 1 errors grow like e^t/R.
        assert_close(frame.length, TAU * radius, 5e-6);
    }
}

#[test]
fn a_circle_with_an_area_penalty_comes_to_rest_where_the_forces_balance() {
    let (penalty, ratio) = (20.0, 1.2);
    let record = run(&scene(&format!(
        "
        curve = {{ shape = 'circle', radius = 1.0 }}
        energy.bending.rigidity = 1.0
        energy.area = {{ penalty = {penalty:?}, target_ratio = {ratio:?} }}
        time = {{ end = 100.0 }}
        accuracy = {{ tolerance = 1e-7, nodes = 64 }}
        "
    )));
    // 1/(2R³) = β(πR² − A*).
    let balance = bisection([0.8, 2.0], |r| penalty * PI * (r * r - ratio) - 0.5 / (r * r * r));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert_close(last(&record).length, TAU * balance, 3e-5);
}

#[test]
fn a_circle_of_the_area_that_it_wants_stays() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.0 }
        energy.area = { penalty = 20.0, target_ratio = 1.0 }
        time = { end = 1.0, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-5, nodes = 64 }
        ",
    ));
    assert_close(last(&record).length, TAU, 1e-14);
}

#[test]
fn a_stiff_area_penalty_holds_the_area_of_any_curve() {
    let changes = [("energy.area", "{ penalty = 1e4, target_ratio = 1.0 }"), ("time.end", "0.1")];
    let record = run(&shipped("length_penalty", &changes));
    assert!(largest_rise(&record) < 1e-12);
    // Forces of order 10 move the area by 10/β.
    assert_close(last(&record).area, record.frames[0].area, 2e-3);
}

#[test]
fn springs_between_all_points_of_a_circle_shrink_it() {
    let record = run(&scene(
        "
        curve = { shape = 'circle', radius = 1.0 }
        energy.adhesion.kernel = 'q'
        time = { end = 0.05, stop_at_equilibrium = false }
        accuracy = { tolerance = 1e-8, nodes = 64 }
        output.frames = 20
        ",
    ));
    // ∬|γ − γ′|² dσ dσ′ = 2|Γ|²R² = 8π²R⁴, so R′ = −16πR².
    for frame in &record.frames {
        let radius = 1.0 / (1.0 + 16.0 * PI * frame.time);
        assert_close(frame.length, TAU * radius, 1e-6);
        assert_close(frame.energy, 8.0 * PI * PI * radius.powi(4), 1e-5);
    }
}

#[test]
fn adhesion_lowers_the_energy_at_every_step_with_any_cut_off() {
    for cutoff in ["2.5", "3.5", "10"] {
        let record = run(&shipped("adhesion", &[("energy.adhesion.cutoff", cutoff)]));
        assert!(largest_rise(&record) < 1e-12, "cutoff {cutoff}");
        let frame = last(&record);
        // The error of the integration.
        assert!(frame.energy_balance.abs() < 1e-4 * frame.energy, "{:.1e}", frame.energy_balance);
        let whole = run(&shipped("adhesion", &[]));
        // 4q e^{−4q} is 1e-10 at the least of them.
        assert_close(frame.energy, last(&whole).energy, 1e-6);
    }
}

#[test]
fn the_curve_moves_at_its_normal_velocity_wherever_it_points() {
    for gauge in ["'scaled-arc-length'", "'graded'\ngrading = '1 + 0.4*cos(2*pi*s)'", "'co-moving'"] {
        let record = run(&scene(&format!(
            "
            [curve]
            shape = 'parametric'
            x = '(1 + 0.3*cos(2*phi) + 0.2*sin(3*phi) + 0.1*sin(phi))*cos(phi + 1)'
            y = '(1 + 0.3*cos(2*phi) + 0.2*sin(3*phi) + 0.1*sin(phi))*sin(phi + 1)'
            [energy]
            bending.rigidity = 1.0
            length = {{ penalty = 5.0, target_ratio = 1.0 }}
            [flow]
            gauge = {gauge}
            [time]
            end = 0.1
            stop_at_equilibrium = false
            [accuracy]
            tolerance = 1e-8
            nodes = 128
            [output]
            times = [0.0399, 0.04, 0.0401]
            "
        )));
        let [before, now, after] = [1, 2, 3].map(|frame| &record.frames[frame]);
        let axis = |axis: usize| Interpolant::new(&now.position.iter().map(|x| x[axis]).collect::<Vec<_>>());
        let slopes = [axis(0), axis(1)];
        let largest = now.normal_velocity.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        for (node, velocity) in now.normal_velocity.iter().enumerate() {
            let s = node as f64 / now.position.len() as f64;
            let [tx, ty] = [0, 1].map(|axis| slopes[axis].slope_at(s) / now.metric[node]);
            let [x, y] = [0, 1].map(|axis| after.position[node][axis] - before.position[node][axis]);
            let moved = (x * ty - y * tx) / (after.time - before.time);
            assert!((moved - velocity).abs() < 1e-4 * largest, "{gauge}, node {node}: {moved} {velocity}");
        }
    }
}

/// Without its tension in the implicit operator such a flow is stepped as if explicitly: thousands of steps, or no end at all.
#[test]
fn tension_is_implicit_beside_positions() {
    for (shape, beside) in [
        ("'ellipse', semi_axes = [3.0, 1.0]", "area = { penalty = 10.0, target_ratio = 1.0 }"),
        ("'trillium'", "area = { penalty = 10.0, target_ratio = 1.0 }"),
        ("'trillium'", "adhesion.kernel = '(1 - q/0.25)*exp(-q/0.25)'"),
    ] {
        for tolerance in ["1e-2", "1e-3", "1e-4"] {
            let record = run(&scene(&format!(
                "
                curve = {{ shape = {shape} }}
                energy = {{ length.tension = 1.0, {beside} }}
                time = {{ end = 0.3, stop_at_equilibrium = false, max_steps = 300 }}
                accuracy.tolerance = {tolerance}
                output.frames = 1
                "
            )));
            let steps = record.counters.steps;
            println!("{shape}, {beside}, {tolerance}: {steps} steps");
            assert_eq!(record.stop_reason, StopReason::EndTime, "{shape}, {beside}, {tolerance}");
            assert!(steps < 100, "{shape}, {beside}, {tolerance}: {steps} steps");
        }
    }
}

/// The pressure of a stiff penalty makes `p_κ` so large that the implicit operator must hold what the fields do to the tension.
#[test]
fn a_stiff_penalty_on_the_area_is_no_burden() {
    for tolerance in ["1e-2", "1e-3", "1e-5"] {
        let record = run(&scene(&format!(
            "
            curve = {{ shape = 'ellipse', semi_axes = [1.3, 1.0] }}
            energy.bending.rigidity = 1.0
            energy.length = {{ penalty = 1e4, target_ratio = 1.0 }}
            energy.area = {{ penalty = 1e4, target_ratio = 0.5 }}
            time = {{ end = 1.0, stop_at_equilibrium = false, max_steps = 3000 }}
            accuracy.tolerance = {tolerance}
            output.frames = 1
            "
        )));
        println!("{tolerance}: {} steps", record.counters.steps);
        assert_eq!(record.stop_reason, StopReason::EndTime, "{tolerance}");
        assert!(record.counters.steps < 800, "{tolerance}: {} steps", record.counters.steps);
    }
}
