//! Where the time of a run went: shares that add up, with every term that the scene names, and what is said of them.

use std::ops::ControlFlow;

use flow_core::integrator::Activity;
use flow_core::run::scene::LinearSolver;
use flow_core::run::{
    Counters, Limit, Observer, Progress, Quiet, Record, Rejections, Scene, Seconds, Simulation, Spending,
    StopReason, WhySlow, run,
};

mod synthetic;

/// A shipped scene up to `end`, on 256 nodes, with implicit steps.
fn shipped(name: &str, end: &str) -> Scene {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    let changes = [
        ("time.end", end),
        ("output.frames", "3"),
        ("accuracy.nodes", "256"),
        ("accuracy.linear_solver", "fourier"),
    ];
    let changes = changes.map(|(key, value)| (key.into(), value.into()));
    Scene::parse_with(text, name, &changes).expect("valid")
}

fn record(name: &str, end: &str) -> Record {
    run(&shipped(name, end), &mut Quiet).expect("an initial state")
}

fn assert_sum(shares: impl IntoIterator<Item = f64>, total: f64) {
    let sum: f64 = shares.into_iter().inspect(|share| assert!(*share >= 0.0, "{share}")).sum();
    assert!((sum - total).abs() <= 1e-9 * total, "{sum} is not {total}");
}

#[test]
fn shares_are_not_negative_and_add_up() {
    let scenes = [
        ("three_fold", "1e-3"),
        ("adhesion", "1e-3"),
        ("incompressible", "1e-3"),
        ("membrane_penalty", "1e-3"),
    ];
    for (name, end) in scenes {
        let record = record(name, end);
        let why = WhySlow::of(&record);
        assert!(why.total > 0.0, "{name}");
        assert_sum(why.activities.iter().map(|share| share.share), 1.0);
        assert_sum(why.activities.iter().map(|share| share.seconds), record.seconds.total());
        assert_sum(why.evaluations.iter().map(|share| share.seconds), record.seconds.in_evaluations());
        let aside = Spending::ALL.into_iter().filter(|spending| !matches!(spending, Spending::Step(_)));
        let aside: f64 = aside.map(|spending| record.seconds[spending]).sum();
        assert_sum([record.seconds.total() - aside], record.counters.integration_seconds);
        for term in &record.energy_terms {
            assert!(why.evaluations.iter().any(|share| share.name == *term), "{name}: {term}");
        }
        assert_eq!(record.seconds.evaluations.terms.len(), record.energy_terms.len(), "{name}");
    }
}

#[test]
fn what_a_scene_does_costs_and_what_it_does_not_do_costs_nothing() {
    let record = record("adhesion", "1e-2");
    let seconds = &record.seconds;
    for (name, seconds) in seconds.by_activity() {
        match name {
            "remaps" | "observers" | "output" => assert_eq!(seconds, 0.0, "{name}"),
            "right_hand_sides" => {} // a linearisation has one, and most steps need no other
            _ => assert!(seconds > 0.0, "{name}"),
        }
    }
    let term = |name: &str| {
        let place = record.energy_terms.iter().position(|term| term == name).expect("a term of the scene");
        seconds.evaluations.terms[place]
    };
    // All pairs of 256 nodes against a square at each of them.
    assert!(term("adhesion") > 10.0 * term("bending"), "{:?}", seconds.evaluations);
}

#[test]
fn exponential_steps_solve_no_systems() {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "length_penalty").expect("shipped");
    let record =
        run(&Scene::parse(text, "length_penalty").expect("valid"), &mut Quiet).expect("an initial state");
    for (name, seconds) in record.seconds.by_activity() {
        match name {
            "factorisations" | "jacobian_products" | "solves" | "krylov" => {
                assert_eq!(seconds, 0.0, "{name}");
            }
            "checks" | "right_hand_sides" | "step_control" | "remaps" => assert!(seconds > 0.0, "{name}"),
            _ => {}
        }
    }
    let Counters { steps, right_hand_sides, krylov_iterations, .. } = record.counters;
    assert_eq!(krylov_iterations, 0);
    assert!(right_hand_sides <= 3 * steps, "two for each step: {right_hand_sides} for {steps}");
}

#[test]
fn a_switch_of_the_gauge_is_a_remap() {
    let switch = "[{ time = 0.002, gauge = 'graded', grading = 'exp(0.5*cos(6*pi*s))' }]";
    let changes = [("flow.switch".to_owned(), switch.to_owned())];
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "length_penalty").expect("shipped");
    let scene = Scene::parse_with(text, "length_penalty", &changes).expect("valid");
    let record = run(&scene, &mut Quiet).expect("an initial state");
    assert!(record.seconds[Spending::Remaps] > 0.0);
    let why = WhySlow::of(&record);
    assert_sum(why.activities.iter().map(|share| share.share), 1.0);
}

/// Looks at the record after every step, which replays the parts of the evaluations.
#[test]
fn looking_at_the_clocks_changes_no_bit() {
    let scene = shipped("three_fold", "1e-4");
    let whole = run(&scene, &mut Quiet).expect("an initial state");
    let mut watched = Simulation::new(&scene).expect("an initial state");
    while watched.step(&mut Quiet) {
        assert!(watched.record().seconds.total() > 0.0);
    }
    let watched = watched.into_record();
    assert_eq!(watched.steps, whole.steps);
    assert!(watched.frames == whole.frames, "the frames differ");
}

struct Busy;

impl Observer for Busy {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        std::thread::sleep(std::time::Duration::from_millis(5));
        ControlFlow::Continue(())
    }
}

#[test]
fn those_who_watch_are_named() {
    let record = run(&shipped("circle", "1e-3"), &mut Busy).expect("an initial state");
    let why = WhySlow::of(&record);
    assert_eq!(why.limit, Limit::Observers, "{why}");
    assert_eq!(why.activities[0].name, "observers");
    assert!(why.sentence.contains("watch"), "{}", why.sentence);
}

/// A record with the counters and seconds that `change` makes of quick steps.
fn limit(change: impl FnOnce(&mut Seconds, &mut Counters)) -> Limit {
    let mut record = synthetic::record(3, 16, &["rho"]);
    let counters = Counters {
        steps: 100,
        newton_iterations: 100,
        krylov_iterations: 300,
        rejections: Rejections { error: 5, ..Rejections::default() },
        ..Counters::default()
    };
    let products = Spending::Step(Activity::JacobianProduct);
    let mut seconds = Seconds::default();
    seconds[products] = 1.0;
    (record.seconds, record.counters) = (seconds, counters);
    change(&mut record.seconds, &mut record.counters);
    let why = WhySlow::of(&record);
    assert!(!why.sentence.is_empty() && !why.advice.is_empty());
    why.limit
}

#[test]
fn each_limit_has_its_cause() {
    assert_eq!(limit(|_, _| ()), Limit::Accuracy);
    assert_eq!(limit(|seconds, _| *seconds = Seconds::default()), Limit::NotMeasured);
    assert_eq!(limit(|seconds, _| seconds[Spending::Start] = 2.0), Limit::Start);
    let saving = |frames, output| {
        limit(|seconds, _| (seconds[Spending::Frames], seconds[Spending::Output]) = (frames, output))
    };
    assert_eq!(saving(1.0, 0.5), Limit::Frames);
    assert_eq!(saving(0.5, 1.0), Limit::Output);
    assert_eq!(limit(|seconds, _| seconds[Spending::Observers] = 2.0), Limit::Observers);
    assert_eq!(limit(|seconds, _| seconds.evaluations.terms = vec![0.9, 0.1]), Limit::Term);
    assert_eq!(limit(|_, counters| counters.rejections.energy_rise = 20), Limit::EnergyRises);
    assert_eq!(limit(|_, counters| counters.rejections.not_finite = 20), Limit::NotFinite);
    assert_eq!(limit(|_, counters| counters.rejections.solver = 20), Limit::ImplicitSolves);
    assert_eq!(limit(|_, counters| counters.krylov_iterations = 2000), Limit::ImplicitSolves);
}

#[test]
fn adhesion_has_advice_of_its_own() {
    let mut record = synthetic::record(3, 16, &["rho"]);
    record.counters.rejections = Rejections::default();
    record.counters.unresolved_steps = 0; // what is doubtful has other advice
    record.frames.iter_mut().for_each(|frame| frame.energy_balance = frame.remap_error);
    let mut advice = |name: &str, dear: &str| {
        let mut scene = shipped(name, "1");
        scene.accuracy.linear_solver = LinearSolver::Auto;
        record.resolved_scene = scene.to_toml();
        record.energy_terms = vec![dear.to_owned()];
        record.seconds = Seconds::default();
        record.seconds[Spending::Step(Activity::RightHandSide)] = 1.0;
        record.seconds.evaluations.terms = vec![0.9];
        record.counters.krylov_iterations = 0;
        let of_the_term = WhySlow::of(&record).advice;
        record.counters.krylov_iterations = 20 * record.counters.newton_iterations.max(1);
        [of_the_term, WhySlow::of(&record).advice]
    };
    let [of_the_term, of_the_solves] = advice("adhesion", "adhesion");
    assert!(
        of_the_term.contains("cutoff") && of_the_solves.contains("dense"),
        "{of_the_term}; {of_the_solves}"
    );
    let [of_the_term, of_the_solves] = advice("three_fold", "agents");
    assert!(
        of_the_term.contains("expressions") && !of_the_solves.contains("dense"),
        "{of_the_term}; {of_the_solves}"
    );
}

#[test]
fn a_run_that_failed_is_mended_before_it_is_made_quicker() {
    let mut record = synthetic::record(3, 16, &["rho"]);
    record.stop_reason = StopReason::Failed("no further step".to_owned());
    assert_eq!(WhySlow::of(&record).advice, "first mend what ended the run: no further step");
    record.seconds = Seconds::default();
    record.seconds[Spending::Start] = 1.0;
    assert_eq!(WhySlow::of(&record).advice, "first mend what ended the run: no further step");
}

#[test]
fn the_text_has_the_sentence_the_advice_and_the_terms() {
    let mut record = synthetic::record(3, 16, &["rho"]);
    record.counters.rejections = Rejections::default();
    let text = WhySlow::of(&record).to_string();
    for part in [
        "try: ",
        "energy.agents",
        "energy.length",
        "Jacobian products",
        "0 energy rises",
        "Krylov iterations per solve",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}
