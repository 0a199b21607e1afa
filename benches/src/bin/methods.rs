//! Measures every method with every linear solver, and writes the tables of `benches/README.md`.

use std::process::ExitCode;

use curveflow_benches::measure::{AUXILIARY, Case, Method, Outcome, iterations};
use curveflow_benches::report::{case_head, case_line, iterations_table, publish};

/// Seconds after which a run is given up, and the tighter tolerances are not tried.
const LIMIT: f64 = 8.0;
const REFERENCE_LIMIT: f64 = 300.0;
const REFERENCE_TOLERANCE: f64 = 1e-10;
const TOLERANCES: [f64; 3] = [1e-3, 1e-5, 1e-7];
/// Short runs are repeated until they add up to so many seconds, the resolution of the clock being a few
/// milliseconds.
const REPEATED: f64 = 0.2;
const MOST_REPEATS: f64 = 200.0;

/// A case, the times at which errors are measured (the last is the end), and its linear solvers.
struct Plan {
    case: Case,
    times: &'static [f64],
    solvers: &'static [&'static str],
}

const KRYLOV: &[&str] = &["fourier", "banded", AUXILIARY, "auto"];
const PLANS: [Plan; 5] = [
    Plan { case: case("length_penalty", 256), times: &[0.01], solvers: KRYLOV },
    Plan {
        case: case("length_penalty", 64),
        times: &[0.01],
        solvers: &["fourier", "banded", AUXILIARY, "auto", "dense"],
    },
    Plan { case: case("three_fold", 512), times: &[0.1, 100.0], solvers: KRYLOV },
    Plan { case: central(case("three_fold", 512)), times: &[0.1, 100.0], solvers: KRYLOV },
    Plan { case: case("three_fold_sharp", 1024), times: &[0.1, 100.0], solvers: KRYLOV },
];
/// When the fronts have formed, and the iterations of single systems are counted.
const FRONTS: f64 = 0.01;

const fn case(scene: &'static str, nodes: usize) -> Case {
    Case { scene, nodes, derivative: "fourier" }
}

/// The family whose operator the band of [`AUXILIARY`] is.
const fn central(case: Case) -> Case {
    Case { derivative: "central-2", ..case }
}

fn main() -> ExitCode {
    let mut tables = String::new();
    for plan in &PLANS {
        tables.push_str(&measure(plan));
    }
    let sharp = case("three_fold_sharp", 1024);
    let systems = [sharp, central(sharp)].map(|case| (case, iterations(case, FRONTS)));
    tables.push_str(&iterations_table(&systems, FRONTS));
    publish("tables", &tables)
}

/// All runs of one case as a table, which is printed while it grows.
fn measure(plan: &Plan) -> String {
    let references: Vec<Outcome> = plan
        .times
        .iter()
        .map(|end| Method::Bdf.run(plan.case, "auto", REFERENCE_TOLERANCE, *end, REFERENCE_LIMIT))
        .collect();
    let mut text = case_head(plan.case, plan.times);
    print!("{text}");
    for method in Method::ALL {
        let solvers = if method.is_implicit() { plan.solvers } else { &["auto"] };
        for solver in solvers {
            for tolerance in TOLERANCES {
                let (line, finished) = line(plan, &references, method, solver, tolerance);
                print!("{line}");
                text.push_str(&line);
                if !finished {
                    break;
                }
            }
        }
    }
    text
}

/// One line, and whether the end was reached.
fn line(plan: &Plan, references: &[Outcome], method: Method, solver: &str, tolerance: f64) -> (String, bool) {
    let run = |end| method.run(plan.case, solver, tolerance, end, LIMIT);
    let mut runs: Vec<Outcome> = Vec::new();
    for end in plan.times {
        // What did not reach the early time will not reach the end.
        if runs.iter().all(|run| run.unfinished.is_none()) {
            runs.push(run(*end));
        }
    }
    let error = |index: usize| match (runs.get(index), &references[index]) {
        (Some(run), reference) if run.unfinished.is_none() && reference.unfinished.is_none() => {
            run.errors(&reference.state, plan.case.nodes)
        }
        _ => [f64::NAN; 2],
    };
    let errors = (0..plan.times.len()).map(error).collect();
    let (Some(mut last), Some(end)) = (runs.pop(), plan.times.last()) else { return (String::new(), false) };
    if last.unfinished.is_none() {
        let (mut total, mut count) = (last.seconds, 1.0);
        while total < REPEATED && count < MOST_REPEATS {
            total += run(*end).seconds;
            count += 1.0;
        }
        last.seconds = total / count;
    }
    (case_line(method, solver, tolerance, &last, &errors), last.unfinished.is_none())
}
