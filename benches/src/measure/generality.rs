//! What the core costs beside a solver for one scene, and what its clocks cost.

use std::time::Instant;

use flow_core::integrator::{
    Adaptive, AdaptiveOptions, Clocked, Counters, Finish, INTEGRALS, Integrals, LinearPart, Multistep,
    Problem, Stepper, Stopwatch,
};
use flow_core::run::{ENERGY_TOLERANCE_SHARE, Quiet, Scene, Setup, Spending, run};

use super::costs::seconds;
use super::interleaved::{Times, in_turns};
use crate::stripped::BendingOnly;

const TOLERANCE: f64 = 1e-5;
const RIGIDITY: f64 = 1.0;

/// The method of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// BDF with the Fourier preconditioner.
    Implicit,
    /// Exponential Adams, what a scene takes that names no linear solver.
    Exponential,
}

/// Bending alone, as `length_penalty` without its penalty.
fn bending(nodes: usize, steps: Steps) -> Scene {
    let solver = match steps {
        Steps::Implicit => "fourier",
        Steps::Exponential => "auto",
    };
    let text = format!(
        "curve.shape = 'trillium'\n\
         energy.bending.rigidity = {RIGIDITY}\n\
         time = {{ end = 0.01, stop_at_equilibrium = false }}\n\
         accuracy = {{ tolerance = {TOLERANCE}, nodes = {nodes}, linear_solver = '{solver}' }}\n\
         output.frames = 1\n"
    );
    Scene::parse(&text, "bending").expect("a valid scene")
}

/// Steps, end state and seconds of a run of `problem` from `state`.
struct Run {
    state: Vec<f64>,
    counters: Counters,
    seconds: f64,
}

fn drive<P: Problem>(mut problem: P, mut state: Vec<f64>, end: f64, mut watch: Option<Stopwatch>) -> Run {
    let Finish::Good { energy, integral_rates, .. } = problem.finish(0.0, &mut state) else {
        panic!("the initial state is finite");
    };
    let clock = Instant::now();
    let mut counters = Counters::default();
    let integrals = Integrals::new(0.0, [0.0; INTEGRALS], integral_rates);
    let stepper = Multistep::starting(&mut problem, &state, integrals, TOLERANCE, &mut counters);
    let energy_tolerance = ENERGY_TOLERANCE_SHARE * TOLERANCE;
    let options = AdaptiveOptions { end, most_steps: u64::MAX, energy_tolerance, doubts_gradients: false };
    let mut integration = Adaptive::new(stepper, options, energy, counters);
    while integration.stepper().time() < end {
        let step = match &mut watch {
            None => integration.step(&mut problem),
            Some(watch) => {
                watch.start_step();
                let step = integration.step(&mut Clocked::new(&mut problem, watch));
                watch.end_step();
                step
            }
        };
        step.expect("the scene reaches its end");
    }
    let seconds = clock.elapsed().as_secs_f64();
    Run { state: integration.stepper().state().to_vec(), counters: *integration.counters(), seconds }
}

fn only_bending(nodes: usize, steps: Steps, angle: f64) -> BendingOnly {
    let problem = BendingOnly::new(nodes, RIGIDITY, angle);
    if steps == Steps::Exponential { problem.with_linear_part() } else { problem }
}

fn setup(scene: &Scene) -> Setup {
    Setup::new(scene).expect("the scene has an initial state")
}

/// Times of bending alone.
#[derive(Clone, Copy, Debug)]
pub struct Generality {
    /// Number of nodes.
    pub nodes: usize,
    /// Accepted steps, of all three.
    pub steps: u64,
    /// Seconds of the solver for bending alone.
    pub stripped: Times,
    /// Seconds of the core's flow in the same step loop.
    pub core: Times,
    /// Seconds of the program: with log, clocks and observer, without start and frames.
    pub program: Times,
    /// Whether all end in the same state, to the last bit, after the same work.
    pub same_bits: bool,
}

/// Runs the three in turns.
///
/// # Panics
/// If a run fails.
#[must_use]
pub fn generality(steps: Steps, nodes: usize, rounds: usize) -> Generality {
    let scene = bending(nodes, steps);
    let end = scene.time.end;
    let stripped = || {
        let Setup { state, placement, .. } = setup(&scene);
        drive(only_bending(nodes, steps, placement.angle), state, end, None)
    };
    let core = || {
        let Setup { membrane, state, .. } = setup(&scene);
        drive(membrane, state, end, None)
    };
    let program = || run(&scene, &mut Quiet).expect("the scene has an initial state");
    let (one, other, record) = (stripped(), core(), program());
    // Only the program looks whether its nodes serve.
    let work = |counters: &Counters| Counters { integration_seconds: 0.0, unresolved_steps: 0, ..*counters };
    let same_work =
        work(&one.counters) == work(&other.counters) && work(&record.counters) == work(&one.counters);
    let [stripped, core, program] = in_turns(
        rounds,
        [&|| stripped().seconds, &|| core().seconds, &|| {
            let record = program();
            record.counters.integration_seconds + record.seconds[Spending::Observers]
        }],
    );
    Generality {
        nodes,
        steps: one.counters.steps,
        stripped,
        core,
        program,
        same_bits: one.state == other.state && same_work,
    }
}

/// Names of the calls of [`calls`].
pub const CALLS: [&str; 9] = [
    "right-hand side",
    "linearisation",
    "J·v",
    "factorisation",
    "solve",
    "weights of a residual",
    "check",
    "rate after a check",
    "linear part",
];

/// Least seconds of one call each of the solver for bending alone and of the core, in the order of [`CALLS`].
#[must_use]
pub fn calls(nodes: usize) -> [[f64; CALLS.len()]; 2] {
    let Setup { membrane, state, placement, .. } = setup(&bending(nodes, Steps::Exponential));
    [least(only_bending(nodes, Steps::Exponential, placement.angle), &state), least(membrane, &state)]
}

fn least<P: Problem>(mut problem: P, state: &[f64]) -> [f64; CALLS.len()] {
    const GAMMA: f64 = 1e-5;
    let (mut out, mut y) = (vec![0.0; state.len()], state.to_vec());
    let rate = seconds(|| problem.rate(state, &mut out));
    let linearisation = seconds(|| problem.linearise(state, &mut out));
    let v = out.clone();
    let product = seconds(|| problem.jacobian_product(&v, &mut out));
    let factorisation = seconds(|| _ = problem.factorise(GAMMA));
    let solve = seconds(|| problem.precondition(&mut out));
    out.copy_from_slice(&v);
    let weights = seconds(|| problem.weigh(&mut out));
    let mut checked = |rated: bool| {
        seconds(|| {
            y.copy_from_slice(state);
            problem.finish(0.0, &mut y);
            if rated {
                problem.finished_rate(state, &mut out);
            }
        })
    };
    // It takes up what the check has left, once.
    let check = checked(false);
    let finished_rate = checked(true) - check;
    let mut part = LinearPart::default();
    let linear_part = seconds(|| _ = problem.linear_part(state, &mut part));
    [rate, linearisation, product, factorisation, solve, weights, check, finished_rate, linear_part]
}

/// Seconds of the steps of a shipped scene without and with the stopwatch of a run.
///
/// # Panics
/// If there is no such scene, or a run fails.
#[must_use]
pub fn clocks(name: &str, rounds: usize) -> [Times; 2] {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("a shipped scene");
    let scene = Scene::parse(text, name).expect("shipped scenes are valid");
    // Once at rest, steps cost nothing but rounding: the equilibrium of three_fold is before.
    let end = scene.time.end.min(1.0);
    let timed = |watch: Option<Stopwatch>| {
        let Setup { membrane, state, .. } = setup(&scene);
        drive(membrane, state, end, watch).seconds
    };
    in_turns(rounds, [&|| timed(None), &|| timed(Some(Stopwatch::default()))])
}
