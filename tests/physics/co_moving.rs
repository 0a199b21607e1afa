//! The co-moving gauge: nodes are material points, and the curve is that of the other gauges.

use curveflow_tests::physics::fields::Interpolant;
use curveflow_tests::{largest_rise, last, run, scene, shipped};
use flow_core::run::{Frame, Quiet, Record, StopReason};

/// Largest distance of the nodes of `frame` from the curve `uniform`, which has uniform nodes, relative to the length.
fn distance(uniform: &Frame, frame: &Frame) -> f64 {
    let axis = |k: usize| Interpolant::new(&uniform.position.iter().map(|at| at[k]).collect::<Vec<_>>());
    let (x, y) = (axis(0), axis(1));
    let count = uniform.position.len();
    let to_curve = |p: &[f64; 2]| {
        let squares = uniform.position.iter().map(|at| (at[0] - p[0]).powi(2) + (at[1] - p[1]).powi(2));
        let (nearest, _) = squares
            .enumerate()
            .fold((0, f64::INFINITY), |best, (i, d)| if d < best.1 { (i, d) } else { best });
        let mut s = nearest as f64 / count as f64;
        for _ in 0..5 {
            let (tx, ty) = (x.slope_at(s), y.slope_at(s));
            s += ((p[0] - x.at(s)) * tx + (p[1] - y.at(s)) * ty) / (tx * tx + ty * ty);
        }
        (p[0] - x.at(s)).hypot(p[1] - y.at(s))
    };
    frame.position.iter().map(to_curve).fold(0.0, f64::max) / uniform.length
}

fn balance(record: &Record) -> f64 {
    (last(record).energy_balance / record.frames[0].energy).abs()
}

#[test]
fn the_curve_is_that_of_the_scaled_arc_length() {
    for (scene, nodes, solver, end) in [
        ("length_penalty", "256", "fourier", "0.01"),
        ("incompressible", "256", "fourier", "0.01"),
        ("three_fold", "512", "banded", "0.02"),
    ] {
        let mut changes = vec![
            ("accuracy.nodes", nodes),
            ("accuracy.tolerance", "1e-8"),
            ("time.stop_at_equilibrium", "false"),
            ("time.end", end),
        ];
        // Implicit steps, as those that co-moving nodes take.
        let uniform = run(&shipped(scene, &[&changes[..], &[("accuracy.linear_solver", solver)]].concat()));
        changes.push(("flow.gauge", "co-moving"));
        let moving = run(&shipped(scene, &changes));
        let (a, b) = (last(&uniform), last(&moving));
        let energy = (a.energy / b.energy - 1.0).abs();
        let dissipation = (a.dissipation / b.dissipation - 1.0).abs();
        let image = distance(a, b);
        let work = |record: &Record| (record.counters.steps, record.counters.krylov_iterations);
        println!(
            "{scene}: energy {energy:.1e}, dissipation {dissipation:.1e}, image {image:.1e}, work {:?} {:?}",
            work(&uniform),
            work(&moving)
        );
        assert!(largest_rise(&moving) <= 1e-13, "{scene}: {:.1e}", largest_rise(&moving));
        assert!(energy < 5e-6, "{scene}: {energy:.1e}");
        assert!(dissipation < 1e-4, "{scene}: {dissipation:.1e}");
        assert!(image < 1e-6, "{scene}: {image:.1e}");
        assert!(balance(&moving) < 1e-6, "{scene}: {:.1e}", balance(&moving));
        // The implicit operator holds the metric: the steps are those of the other gauge.
        assert!(5 * moving.counters.steps <= 6 * uniform.counters.steps, "{scene}");
        assert!(moving.counters.krylov_iterations <= 4 * uniform.counters.krylov_iterations, "{scene}");
        let [tall, low] = [f64::max, f64::min].map(|of| b.metric.iter().copied().reduce(of).expect("nodes"));
        assert!(scene == "incompressible" || tall > 1.05 * low, "{scene}: the metric moves");
    }
}

#[test]
fn every_node_keeps_the_mass_that_it_carries() {
    let changes = [
        ("flow.gauge", "co-moving"),
        ("accuracy.nodes", "512"),
        ("density.protein.mobility", "none"),
        ("time.end", "0.002"),
        ("time.stop_at_equilibrium", "false"),
    ];
    let record = run(&shipped("three_fold", &changes));
    assert_eq!(record.stop_reason, StopReason::EndTime);
    let (first, end) = (&record.frames[0], last(&record));
    let mut moved = 0.0_f64;
    for node in 0..record.nodes() {
        let mass = |frame: &Frame| frame.density[0][node] * frame.metric[node];
        assert!((mass(end) / mass(first) - 1.0).abs() < 1e-13, "node {node}: {} {}", mass(first), mass(end));
        moved = moved.max((end.metric[node] / first.metric[node] - 1.0).abs());
    }
    assert!(moved > 0.01, "{moved:.1e}");
}

#[test]
fn an_incompressible_curve_keeps_the_length_of_every_piece() {
    // Of the family whose Helmholtz operator is that of the grid; the others keep it to their order.
    let changes = [("flow.gauge", "co-moving"), ("accuracy.tolerance", "1e-8"), ("accuracy.nodes", "512")];
    let record = run(&shipped("incompressible", &changes));
    let (first, end) = (&record.frames[0], last(&record));
    assert!((end.length / first.length - 1.0).abs() < 1e-12);
    // ∂_tg = gκ𝓘V̂ = −g∇_s(flux): pieces are stretched by what flows into them, so the length as a whole is kept only.
    let change = first.metric.iter().zip(&end.metric).map(|(a, b)| (b / a - 1.0).abs()).fold(0.0, f64::max);
    assert!(change > 1e-3, "{change:.1e}");
}

/// On many nodes the steps leave the most to the solver; a balance that is wrong there was seen once.
#[test]
fn fine_nodes_keep_the_balance_of_the_energy() {
    let record = run(&shipped("three_fold", &[("flow.gauge", "co-moving"), ("accuracy.nodes", "768")]));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert!(balance(&record) < 2e-5, "{:.1e}", balance(&record));
    assert!((last(&record).energy / 5.604_830_56 - 1.0).abs() < 1e-6, "{}", last(&record).energy);
    assert!(record.counters.rejections.solver == 0, "{:?}", record.counters);
}

#[test]
fn every_mobility_runs() {
    for mobility in [
        "identity",
        "incompressible",
        "area-preserving",
        "incompressible-area-preserving",
        "surface-diffusion",
    ] {
        let changes = [
            ("flow.gauge", "co-moving"),
            ("flow.normal_mobility", mobility),
            ("time.end", "0.001"),
            ("time.stop_at_equilibrium", "false"),
        ];
        let record = run(&shipped("length_penalty", &changes));
        assert_eq!(record.stop_reason, StopReason::EndTime, "{mobility}");
        assert!(largest_rise(&record) <= 1e-13, "{mobility}: {:.1e}", largest_rise(&record));
        let (first, end) = (&record.frames[0], last(&record));
        let area = (end.area / first.area - 1.0).abs();
        let length = (end.length / first.length - 1.0).abs();
        println!("{mobility}: area {area:.1e}, length {length:.1e}, {:?}", record.counters);
        assert_eq!(
            area < 1e-12,
            mobility != "identity" && mobility != "incompressible",
            "{mobility}: {area:.1e}"
        );
        assert_eq!(length < 1e-12, mobility.starts_with("incompressible"), "{mobility}: {length:.1e}");
    }
}

#[test]
fn a_run_switches_to_it_and_back() {
    let whole = [("accuracy.tolerance", "1e-8"), ("accuracy.nodes", "384")];
    let switches = "[{ time = 0.001, gauge = 'co-moving' }, { time = 0.004, gauge = 'scaled-arc-length' }]";
    let unbroken = run(&shipped("length_penalty", &whole));
    let switched = run(&shipped("length_penalty", &[&whole[..], &[("flow.switch", switches)]].concat()));
    let (a, b) = (last(&unbroken), last(&switched));
    assert_eq!(switched.counters.remaps, 2);
    assert!((b.remap_error / b.energy).abs() < 1e-9, "{:.1e}", b.remap_error);
    assert!((a.energy / b.energy - 1.0).abs() < 1e-7, "{} {}", a.energy, b.energy);
    assert!(distance(a, b) < 1e-7, "{:.1e}", distance(a, b));
}

/// Runs to rest in the scaled arc length and with co-moving nodes.
fn at_rest(scene: &str, nodes: &str, changes: &[(&str, &str)]) -> [Record; 2] {
    let mut all = vec![("accuracy.nodes", nodes), ("time.stop_at_equilibrium", "true"), ("time.end", "1000")];
    // Implicit steps, as those that co-moving nodes take.
    let solver = if scene == "three_fold" { "banded" } else { "fourier" };
    let uniform = run(&shipped(scene, &[&all[..], &[("accuracy.linear_solver", solver)]].concat()));
    all.extend(changes);
    let moving = run(&shipped(scene, &all));
    for (record, gauge) in [(&uniform, "uniform"), (&moving, "moving")] {
        assert_eq!(record.stop_reason, StopReason::Equilibrium, "{scene}, {gauge}");
        let rise = largest_rise(record);
        assert!(rise <= 1e-13, "{scene}, {gauge}: {rise:.1e}");
        println!(
            "{scene}, {gauge}: t = {:.3}, energy {:.7}, dissipation {:.1e}, balance {:.1e}, {} steps, {} Krylov, {:?}",
            last(record).time,
            last(record).energy,
            last(record).dissipation,
            balance(record),
            record.counters.steps,
            record.counters.krylov_iterations,
            record.counters.rejections
        );
    }
    [uniform, moving]
}

#[test]
fn it_comes_to_rest_by_itself() {
    for (scene, nodes) in [
        ("length_penalty", "256"),
        ("incompressible", "256"),
        ("membrane_penalty", "256"),
        ("three_fold", "512"),
    ] {
        let [uniform, moving] = at_rest(scene, nodes, &[("flow.gauge", "co-moving")]);
        let (a, b) = (last(&uniform), last(&moving));
        println!("image {:.1e}", distance(a, b));
        // Measured: 1e-6 and below, and 8.9e-5 for `three_fold`, whose 512 nodes are far apart where the membrane has stretched.
        assert!(distance(a, b) < 2e-4, "{scene}: {:.1e}", distance(a, b));
        assert!((a.energy / b.energy - 1.0).abs() < 1e-5, "{scene}: {} {}", a.energy, b.energy);
        assert!((a.length / b.length - 1.0).abs() < 1e-5, "{scene}: {} {}", a.length, b.length);
        assert!(balance(&moving) < 3e-5, "{scene}: {:.1e}", balance(&moving));
        assert!(5 * moving.counters.steps <= 6 * uniform.counters.steps, "{scene}");
    }
}

#[test]
fn a_run_that_switches_on_the_way_comes_to_the_same_rest() {
    for (scene, nodes, switches) in [
        ("length_penalty", "256", "[{ time = 0.002, gauge = 'co-moving' }]"),
        (
            "membrane_penalty",
            "256",
            "[{ time = 0.002, gauge = 'co-moving' }, { time = 0.1, gauge = 'scaled-arc-length' }]",
        ),
        ("three_fold", "512", "[{ time = 0.05, gauge = 'co-moving' }]"),
    ] {
        let [uniform, switched] = at_rest(scene, nodes, &[("flow.switch", switches)]);
        let (a, b) = (last(&uniform), last(&switched));
        println!("image {:.1e}, remap error {:.1e}", distance(a, b), b.remap_error);
        assert!(distance(a, b) < 2e-5, "{scene}: {:.1e}", distance(a, b));
        assert!((a.energy / b.energy - 1.0).abs() < 1e-5, "{scene}: {} {}", a.energy, b.energy);
        assert!((a.length / b.length - 1.0).abs() < 1e-5, "{scene}: {} {}", a.length, b.length);
    }
}

/// What slopes of an expression cost is in the preconditioner of moving nodes too.
#[test]
fn expressions_of_slopes_take_few_iterations_where_nodes_move() {
    let record = run(&scene(
        "
        curve = { shape = 'trillium' }
        density = [{ name = 'a', initial = '0.7 + 0.2*sin(2*pi*s)', mobility = 'diffusion' }]
        energy = { bending.rigidity = 1.0, length = { penalty = 20.0, target_ratio = 1.0 }, local.expression = '0.3*a_sigma^2' }
        flow.gauge = 'co-moving'
        time = { end = 0.05, max_steps = 400, stop_at_equilibrium = false }
        accuracy.tolerance = 1e-3
        ",
    ));
    println!("{:?}", record.counters);
    assert_eq!(record.stop_reason, StopReason::EndTime);
    assert!(record.counters.krylov_iterations < 10 * record.counters.newton_iterations);
}

/// The band of moving nodes has as many of them as the flow: on more than it had, this flow took steps of 1e-7.
#[test]
fn many_moving_nodes_take_few_steps() {
    let record = run(&shipped(
        "three_fold",
        &[
            ("flow.gauge", "'co-moving'"),
            ("accuracy.nodes", "1296"),
            ("accuracy.tolerance", "1e-4"),
            ("time.end", "0.02"),
            ("time.max_steps", "300"),
        ],
    ));
    println!("{:?}", record.counters);
    assert_eq!(record.stop_reason, StopReason::EndTime);
    assert!(record.counters.rejections.solver < 5);
}

/// A step that is shorter than the rounding of the state does not move it, and says nothing of how far it is from rest.
#[test]
fn a_switch_at_once_is_no_rest() {
    for time in ["1e-16", "1e-18", "1e-20"] {
        let record = run(&scene(&format!(
            "
            curve = {{ shape = 'circle', radius = 1.0 }}
            energy.bending.rigidity = 1.0
            flow = {{ gauge = 'co-moving', switch = [{{ time = {time}, gauge = 'scaled-arc-length' }}] }}
            time.end = 0.5
            "
        )));
        assert_eq!(record.stop_reason, StopReason::EndTime, "{time}");
        // E = π/R, R⁴ = 1 + 2t.
        let exact = std::f64::consts::PI / 2.0_f64.powf(0.25);
        assert!((last(&record).energy / exact - 1.0).abs() < 1e-4, "{time}: {}", last(&record).energy);
    }
}

/// A circle that shrinks to a point, on nodes as uneven as they were put: what else may be why is said where it may.
#[test]
fn where_co_moving_nodes_lie_unevenly_a_failure_says_so() {
    for (grading, uneven) in [(0.92, true), (0.3, false)] {
        let text = format!(
            "curve = {{ shape = 'circle', radius = 1.0 }}\n\
             energy.length.tension = 1.0\n\
             time.end = 2.0\n\
             flow = {{ gauge = 'co-moving', grading = '1 + {grading}*cos(2*pi*s)' }}\n\
             accuracy = {{ tolerance = 1e-3, nodes = 128 }}\n"
        );
        let record = flow_core::run::run(&scene(&text), &mut Quiet).expect("an initial state");
        let StopReason::Failed(message) = record.stop_reason else { panic!("{:?}", record.stop_reason) };
        assert!(message.contains("step size fell"), "{message}");
        assert_eq!(message.contains("24 times as far apart"), uneven, "{message}");
        assert_eq!(message.contains("scaled-arc-length"), uneven, "{message}");
    }
}
