//! The dial tells the truth: what a tolerance buys, in time and space, on every shipped scene.

use curveflow_tests::shipped;
use flow_core::run::tradeoff::{Ladder, tradeoff};
use flow_core::run::{Quiet, Scene, run};

/// Least and largest ratio of the error that is measured to the one asked for: 0.04 and 5.3 where the table of
/// `benches/README.md` was made. Rounding tips step sizes, and a flow that multiplies errors makes much of that, so there is a
/// factor of two on either side.
const LEAST: f64 = 0.015;
const MOST: f64 = 20.0;

/// The largest error of curve, curvature, densities, energy and length, halfway and at the end, against a run a hundred times
/// tighter than the tightest on as many nodes as that needs.
fn check(name: &str) {
    let measured = tradeoff(&shipped(name, &[]), &Ladder::default(), &mut Quiet).expect("measured");
    let errors: Vec<_> =
        measured.rungs().map(|(tolerance, rung)| (tolerance, rung.largest_error())).collect();
    assert_eq!(errors.len(), 7, "{name}: 1e-2 … 1e-8");
    for (tolerance, error) in &errors {
        let got = error / tolerance;
        assert!((LEAST..=MOST).contains(&got), "{name} at {tolerance:e}: {got:.3} of what was asked for");
    }
    assert!(
        errors.windows(2).all(|pair| pair[1].1 <= pair[0].1),
        "{name}: a tighter tolerance is worse: {errors:?}"
    );
}

/// What the solves of past stages leave is no error of a step: on twice the nodes that the tolerance needs, a run took ten times
/// the steps while it was counted as one.
#[test]
fn solves_do_not_shorten_the_steps() {
    let steps = |nodes: &str| {
        let changes = [("accuracy.nodes", nodes), ("accuracy.tolerance", "1e-8"), ("time.end", "0.1")];
        run(&shipped("blend", &changes), &mut Quiet).expect("a good scene").counters.steps
    };
    let (few, many) = (steps("192"), steps("384"));
    println!("{few} and {many} steps");
    assert!(many < 4 * few, "{few} and {many} steps");
}

/// A linear part that is as old as a curve four times as stiff let noise of fifty tolerances grow in its shortest waves, and the run
/// go over to implicit steps of order 1.
#[test]
fn of_a_curve_that_shrinks() {
    let text = "curve.shape = 'ellipse'
        curve.semi_axes = [1.1, 1.6]
        energy.bending.rigidity = 0.466
        energy.bending.preferred_curvature = 1.03
        energy.length.tension = 1.82
        time.end = 0.5857
        time.stop_at_equilibrium = false";
    measure(text, &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7], 90);
}

/// What the density does to its curve makes the shortest waves stiff, where exponential steps do not see it before they have grown from
/// rounding; a density that is carried keeps what that leaves: fifty tolerances, on nine times the nodes.
#[test]
fn of_a_density_that_is_carried() {
    let text = "curve.shape = 'polar'
        curve.r = '1.306 - 0.0477*cos(3*phi) + 0.14*sin(4*phi)'
        density = [{ name = 'a', initial = '0.9428 + 0.168*cos(8*pi*s)', mobility = 'none' }]
        energy.local.expression = '0.265*a*ln(a)'
        energy.bending = { rigidity = 2.53, preferred_curvature = '-1.6*rho', density = 'a' }
        energy.length.tension = 2.79
        flow.normal_mobility = 'area-preserving'
        time.end = 0.1471
        time.stop_at_equilibrium = false";
    measure(text, &[1e-4, 1e-5, 1e-6, 1e-7], 200);
}

/// Holds the scene `text` to ten times each of the `tolerances`, in at most `most_steps`.
fn measure(text: &str, tolerances: &[f64], most_steps: u64) {
    let scene = Scene::parse(text, "dial").expect("a good scene");
    let ladder = Ladder::new(tolerances, None).expect("tolerances");
    let measured = tradeoff(&scene, &ladder, &mut Quiet).expect("measured");
    for (tolerance, rung) in measured.rungs() {
        let (got, steps) = (rung.largest_error() / tolerance, rung.steps);
        println!("{tolerance:e}: {got:.3} of it in {steps} steps");
        assert!(got <= 10.0 && steps <= most_steps, "{tolerance:e}: {got:.3} of it in {steps} steps");
    }
}

#[test]
fn of_the_smooth_scenes() {
    for name in ["circle", "length_penalty", "incompressible", "membrane_penalty", "figure_eight"] {
        check(name);
    }
}

#[test]
fn of_adhesion_and_blend() {
    check("adhesion");
    check("blend");
}

#[test]
fn of_three_fold() {
    check("three_fold");
}

#[test]
fn of_three_fold_sharp() {
    check("three_fold_sharp");
}

#[test]
fn every_shipped_scene_is_among_them() {
    let known = "circle length_penalty incompressible membrane_penalty figure_eight adhesion blend three_fold three_fold_sharp";
    for (name, _) in Scene::shipped() {
        assert!(known.split(' ').any(|one| one == *name), "{name} has no test here");
    }
}
