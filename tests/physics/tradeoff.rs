//! The measured trade of accuracy for time, where the truth is known.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use curveflow_tests::{run, scene, shipped};
use flow_core::run::scene::Nodes;
use flow_core::run::tradeoff::{Ladder, LadderObserver, Leg, RunError, TradeoffError, tradeoff};
use flow_core::run::{Frame, Observer, Progress, Quiet};

/// True relative errors of length, curvature and energy of a circle under bending: R(t) = (1 + 2t)^{1/4}.
fn true_errors(frame: &Frame) -> [f64; 3] {
    let radius = (1.0 + 2.0 * frame.time).powf(0.25);
    let curvature = frame.curvature.iter().map(|kappa| (kappa * radius - 1.0).powi(2)).sum::<f64>();
    [
        (frame.length / (TAU * radius) - 1.0).abs(),
        (curvature / frame.curvature.len() as f64).sqrt(),
        (frame.energy * radius / PI - 1.0).abs(),
    ]
}

#[test]
fn errors_on_a_circle_are_the_true_ones_within_a_factor_of_two() {
    let measured = tradeoff(&shipped("circle", &[]), &Ladder::default(), &mut Quiet).unwrap();
    // The energy goes as 1/R: half of what is lost until t = 1 is lost at this time.
    let half = 2.0 / (1.0 + 3.0_f64.powf(-0.25));
    let exact = 0.5 * (half.powi(4) - 1.0);
    assert!((measured.span.halfway - exact).abs() < 1e-3 && measured.span.end == 1.0, "{:?}", measured.span);
    assert_eq!(measured.rungs().count(), 7);
    for (tolerance, rung) in measured.rungs() {
        let (tolerance_text, halfway) = (format!("{tolerance:e}"), format!("{:?}", measured.span.halfway));
        let changes = [("accuracy.tolerance", tolerance_text.as_str())];
        let text =
            shipped("circle", &changes).text().replace("frames = 100", &format!("times = [{halfway}]"));
        let record = run(&scene(&text));
        assert_eq!((record.counters.steps, record.frames.len()), (rung.steps, 3));
        for (frame, errors) in record.frames[1..].iter().zip(&rung.errors) {
            let found = [errors.length, errors.curvature, errors.energy];
            for (found, exact) in found.into_iter().zip(true_errors(frame)) {
                assert!(
                    (0.5..=2.0).contains(&(found / exact)),
                    "{tolerance:e}: {found:.2e}, true {exact:.2e}"
                );
            }
            // The distance of two circles in units of the length.
            assert!((errors.curve * TAU / errors.length - 1.0).abs() < 0.1, "{errors:?}");
        }
    }
}

#[test]
fn the_cheapest_run_is_the_quickest_of_the_good_ones() {
    let measured = tradeoff(&shipped("circle", &[]), &Ladder::default(), &mut Quiet).unwrap();
    let (tolerance, rung) = measured.cheapest(1e-4).unwrap();
    assert!(rung.largest_error() <= 1e-4);
    for (other, quicker) in measured.rungs().filter(|(_, other)| other.seconds < rung.seconds) {
        assert!(quicker.largest_error() > 1e-4, "{other:e} is quicker than {tolerance:e}");
    }
    assert!(measured.cheapest(1e-20).is_none());
}

#[test]
fn more_nodes_in_the_reference_measure_the_error_of_space() {
    let coarse = shipped("length_penalty", &[("accuracy.nodes", "64")]);
    let of_time = tradeoff(&coarse, &Ladder::new(&[1e-7], None).unwrap(), &mut Quiet).unwrap();
    assert!(!of_time.includes_space());
    let both = tradeoff(&coarse, &Ladder::new(&[1e-6, 1e-7], Some(256)).unwrap(), &mut Quiet).unwrap();
    assert!(both.includes_space());
    let errors: Vec<f64> = both.rungs().map(|(_, rung)| rung.largest_error()).collect();
    let (_, alone) = of_time.rungs().next().unwrap();
    println!("space {errors:?}, time {:e}", alone.largest_error());
    assert!(errors[1] > 100.0 * alone.largest_error(), "{errors:?}");
    // No tolerance helps against too few nodes.
    assert!((errors[0] / errors[1] - 1.0).abs() < 0.01, "{errors:?}");
}

#[test]
fn automatic_nodes_are_measured_against_more() {
    let automatic = shipped("length_penalty", &[("accuracy.nodes", "auto")]);
    let measured = tradeoff(&automatic, &Ladder::new(&[1e-3, 1e-6], None).unwrap(), &mut Quiet).unwrap();
    assert!(measured.includes_space());
    let nodes: Vec<usize> = measured.rungs().map(|(_, rung)| rung.nodes).collect();
    assert!(nodes[0] < nodes[1] && nodes[1] < measured.reference.nodes, "{nodes:?}");
}

#[test]
fn all_runs_go_on_to_where_the_scene_comes_to_rest() {
    let ladder = Ladder::new(&[1e-3, 1e-5], None).unwrap();
    let measured = tradeoff(&shipped("figure_eight", &[]), &ladder, &mut Quiet).unwrap();
    assert_eq!(measured.span.ending.name(), "equilibrium");
    assert!(measured.span.end < 100.0 && measured.span.halfway < measured.span.end);
    assert_eq!(measured.rungs().count(), 2);
}

/// Counts the runs, and stops in one of them.
#[derive(Default)]
struct Impatient {
    legs: Vec<Leg>,
    last: usize,
}

impl Observer for Impatient {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        if self.legs.len() == self.last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl LadderObserver for Impatient {
    fn before_run(&mut self, leg: &Leg) {
        self.legs.push(*leg);
    }
}

#[test]
fn an_interrupted_ladder_keeps_the_rungs_that_are_complete() {
    let scene = shipped("circle", &[("accuracy.tolerance", "1e-4"), ("accuracy.nodes", "64")]);
    let ladder = Ladder::new(&[1e-2, 1e-3, 1e-4], None).unwrap();
    let mut observer = Impatient { last: 4, ..Impatient::default() };
    let measured = tradeoff(&scene, &ladder, &mut observer).unwrap();
    assert_eq!(
        observer.legs,
        [
            Leg::Scout { tolerance: 1e-4 },
            Leg::Reference { tolerance: 1e-6, nodes: Nodes::Count(64) },
            Leg::Rung { tolerance: 1e-2, number: 1, count: 3 },
            Leg::Rung { tolerance: 1e-3, number: 2, count: 3 },
        ]
    );
    assert!(measured.is_interrupted());
    let done: Vec<bool> = measured.rows.iter().map(|row| row.outcome.is_ok()).collect();
    assert_eq!(done, [true, false, false]);
    for last in [1, 2] {
        let mut observer = Impatient { last, ..Impatient::default() };
        let stopped = tradeoff(&scene, &ladder, &mut observer);
        assert!(matches!(stopped, Err(TradeoffError::Interrupted)));
    }
}

#[test]
fn what_fails_is_named() {
    let short = shipped("circle", &[("time.max_steps", "10"), ("accuracy.nodes", "64")]);
    let error = tradeoff(&short, &Ladder::new(&[1e-3], None).unwrap(), &mut Quiet);
    assert!(matches!(error, Err(TradeoffError::Scout { .. })), "{error:?}");
    let short = shipped(
        "circle",
        &[("time.max_steps", "10"), ("accuracy.nodes", "64"), ("accuracy.tolerance", "1e-3")],
    );
    let error = tradeoff(&short, &Ladder::new(&[1e-7], None).unwrap(), &mut Quiet);
    assert!(
        matches!(error, Err(TradeoffError::Reference { source: RunError::Failed { .. }, .. })),
        "{error:?}"
    );
    let error = tradeoff(&short, &Ladder::new(&[1e-3], Some(32)).unwrap(), &mut Quiet);
    assert!(matches!(error, Err(TradeoffError::FewerNodes { nodes: 32, least: 64 })), "{error:?}");
    let automatic = shipped("length_penalty", &[("accuracy.tolerance", "1e-3")]);
    let error = tradeoff(&automatic, &Ladder::new(&[1e-2], Some(128)).unwrap(), &mut Quiet);
    assert!(
        matches!(error, Err(TradeoffError::FewerNodes { nodes: 128, least }) if least > 128),
        "{error:?}"
    );
}

/// Exchange takes the density to zero, by e^{−100} and more: its errors are not to be told in units of that.
#[test]
fn a_density_that_has_decayed_has_no_large_errors() {
    let decays = scene(
        "
        curve = { shape = 'ellipse', semi_axes = [2.0, 1.0] }
        density = [{ name = 'a', initial = '0.8 + 0.1*cos(4*pi*s)', mobility = 'exchange' }]
        energy = { local.expression = '5*a^2 + 0.02*a_sigma^2', bending.rigidity = 1.0 }
        time.end = 10.0
        ",
    );
    let measured = tradeoff(&decays, &Ladder::new(&[1e-3, 1e-5], None).unwrap(), &mut Quiet).unwrap();
    for (tolerance, rung) in measured.rungs() {
        assert!(rung.largest_error() < 10.0 * tolerance, "{tolerance:e}: {rung:?}");
    }
    assert_eq!(measured.rungs().count(), 2);
}
