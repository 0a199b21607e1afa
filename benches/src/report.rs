//! The tables as Markdown, and their place in `benches/README.md`.

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

use crate::measure::{Case, Costs, GAMMAS, Method, Outcome, REDUCTION, SIZES, SOLVERS, Unfinished, exponent};

/// Errors of curvature and length, at an early time if there is one, and at the end.
pub type Errors = Vec<[f64; 2]>;

/// Head of the table of one case; errors are given at `times`.
#[must_use]
pub fn case_head(case: Case, times: &[f64]) -> String {
    let last = times.last().copied().unwrap_or_default();
    let mut text = format!("\n### {}, to t = {last}\n\n", case_name(case));
    text.push_str(
        "| method | linear solver | tolerance | ms | steps | right-hand sides | Krylov | factorisations \
         | rejected: error, solver, energy |",
    );
    for time in times {
        let _ = write!(text, " κ, L error at t = {time} |");
    }
    text.push('\n');
    text.push_str(&"| --- ".repeat(3));
    text.push_str(&"| ---: ".repeat(6));
    text.push_str(&"| --- ".repeat(times.len()));
    text.push_str("|\n");
    text
}

fn case_name(case: Case) -> String {
    let family = match case.derivative {
        "fourier" => String::new(),
        family => format!(", {family}"),
    };
    format!("{}, N = {}{family}", case.scene, case.nodes)
}

/// One run as a line.
#[must_use]
pub fn case_line(method: Method, solver: &str, tolerance: f64, run: &Outcome, errors: &Errors) -> String {
    let solver = if method.is_implicit() { solver } else { "–" };
    let counters = &run.counters;
    let rejections = counters.rejections;
    let time = match run.unfinished {
        None => milliseconds(run.seconds),
        Some(Unfinished::TimeLimit) => format!("– (t = {:.1e})", run.time),
        Some(Unfinished::Failed) => format!("failed at t = {:.1e}", run.time),
    };
    let mut line = format!(
        "| {} | {solver} | {tolerance:.0e} | {time} | {} | {} | {} | {} | {}, {}, {} |",
        method.name(),
        counters.steps,
        counters.right_hand_sides,
        counters.krylov_iterations,
        counters.factorisations,
        rejections.error,
        rejections.solver + rejections.not_finite,
        rejections.energy_rise
    );
    for [curvature, length] in errors {
        let _ = write!(line, " {}, {} |", short(*curvature), short(*length));
    }
    line.push('\n');
    line
}

fn short(error: f64) -> String {
    if error.is_finite() { format!("{error:.0e}") } else { "–".to_owned() }
}

fn milliseconds(seconds: f64) -> String {
    let ms = 1e3 * seconds;
    if ms < 10.0 { format!("{ms:.2}") } else { format!("{ms:.0}") }
}

/// A row's name, and what it shows.
type Row = (&'static str, fn(&Costs) -> f64);

/// The table of the costs of the parts.
#[must_use]
pub fn costs_table(costs: &[Costs]) -> String {
    let mut text = format!(
        "\n### Parts of a step, three_fold with N = {} … {}\n\nMicroseconds. Power: fitted power of N.\n\n| |",
        SIZES[0],
        SIZES[SIZES.len() - 1]
    );
    for cost in costs {
        let _ = write!(text, " {} |", cost.nodes);
    }
    text.push_str(" power |\n| --- ");
    text.push_str(&"| ---: ".repeat(costs.len() + 1));
    text.push_str("|\n");
    let rows: [Row; 11] = [
        ("right-hand side", |c| c.rate),
        ("linearisation", |c| c.linearisation),
        ("J·v", |c| c.product),
        ("solve, Fourier", |c| c.solve[0]),
        ("solve, banded", |c| c.solve[1]),
        ("solve, auxiliary", |c| c.solve[2]),
        ("factorisation, Fourier", |c| c.factorisation[0]),
        ("factorisation, banded", |c| c.factorisation[1]),
        ("factorisation, auxiliary", |c| c.factorisation[2]),
        ("step of BDF, auto, tolerance 1e-5, to t = 0.1", |c| c.step),
        ("that whole solve", |c| c.solve_to_end),
    ];
    for (name, part) in rows {
        let _ = write!(text, "| {name} |");
        for cost in costs {
            let _ = write!(text, " {:.1} |", 1e6 * part(cost));
        }
        let pairs: Vec<_> = costs.iter().map(|cost| (cost.nodes as f64, part(cost))).collect();
        let _ = writeln!(text, " {:.2} |", exponent(&pairs));
    }
    text.push_str("| steps (Krylov iterations per step) |");
    for cost in costs {
        let _ = write!(text, " {} ({:.1}) |", cost.steps, cost.krylov_per_step);
    }
    text.push_str(" |\n");
    text
}

/// The table of Krylov iterations of fresh factorisations, for cases with their iterations at `time`.
#[must_use]
pub fn iterations_table(cases: &[(Case, Vec<[usize; SOLVERS.len()]>)], time: f64) -> String {
    let mut text = format!(
        "\n### Krylov iterations with a fresh factorisation, state at t = {time}, residual to {REDUCTION:.0e}\n\n\
         | system | linear solver |"
    );
    for gamma in GAMMAS {
        let _ = write!(text, " γ = {gamma:.0e} |");
    }
    text.push_str("\n| --- | --- ");
    text.push_str(&"| ---: ".repeat(GAMMAS.len()));
    text.push_str("|\n");
    for (case, counts) in cases {
        for (index, solver) in SOLVERS.iter().enumerate() {
            let _ = write!(text, "| {} | {solver} |", case_name(*case));
            for count in counts {
                let _ = write!(text, " {} |", count[index]);
            }
            text.push('\n');
        }
    }
    text
}

/// Writes `text` between the markers `name` of `benches/README.md`, and tells what went wrong.
#[must_use]
pub fn publish(name: &str, text: &str) -> ExitCode {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let written = std::fs::read_to_string(&path).and_then(|document| {
        let document = replace_between(&document, name, text)
            .ok_or_else(|| std::io::Error::other(format!("the markers `{name}` are missing")))?;
        std::fs::write(&path, document)
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

/// `document` with the text between its markers `name` replaced by `text`; none if it has no such markers.
#[must_use]
pub fn replace_between(document: &str, name: &str, text: &str) -> Option<String> {
    let (begin, end) = (format!("<!-- {name}: begin -->"), format!("<!-- {name}: end -->"));
    let begin = document.find(&begin)? + begin.len();
    let end = document.find(&end).filter(|end| *end >= begin)?;
    Some(format!("{}\n{text}\n{}", &document[..begin], &document[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_go_between_the_markers() {
        let document = |text: &str| format!("a\n<!-- tables: begin -->\n{text}\n<!-- tables: end -->\nb\n");
        assert_eq!(replace_between(&document("old"), "tables", "new"), Some(document("new")));
        assert_eq!(replace_between(&document("old"), "other", "new"), None);
        assert_eq!(replace_between("no markers", "tables", "new"), None);
    }
}
