//! Prints the tables of `docs/physics.md` in Markdown, measured afresh.
//!
//! `cargo run --release -p curveflow-tests --bin physics` prints all of them, `-- NAME…` those named;
//! `-- --update docs/physics.md` puts them into the file, between its marks.

mod limit;
mod positions;
mod update;

use std::process::ExitCode;

/// Name of a table, and what makes it.
type Table = (&'static str, fn() -> String);

/// All tables, in the order of the document.
const TABLES: [Table; 8] = [
    ("three-flows", positions::three_flows),
    ("three-flows-aligned", positions::aligned),
    ("labelled-pieces", positions::labelled_pieces),
    ("incompressible-limit", limit::ladder),
    ("incompressible-exponents", limit::exponents),
    ("stiffness", limit::stiffness),
    ("adhesion", positions::adhesion),
    ("figure-eight", positions::figure_eight),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, path] = arguments.as_slice()
        && flag == "--update"
    {
        return match update::update(path, &TABLES) {
            Ok(()) => ExitCode::SUCCESS,
            Err(message) => failure(&message),
        };
    }
    if let Some(unknown) = arguments.iter().find(|name| !TABLES.iter().any(|(table, _)| table == name)) {
        let names: Vec<_> = TABLES.iter().map(|(name, _)| *name).collect();
        return failure(&format!("no table {unknown}; the tables are {}", names.join(", ")));
    }
    for (name, table) in &TABLES {
        if arguments.is_empty() || arguments.iter().any(|argument| argument == name) {
            println!("{}\n{}\n{}\n", update::begin(name), table(), update::END);
        }
    }
    ExitCode::SUCCESS
}

fn failure(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}

/// A Markdown table.
fn markdown(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let rule = vec!["---".to_owned(); head.len()];
    [line(&head), line(&rule)]
        .into_iter()
        .chain(rows.iter().map(|row| line(row)))
        .collect::<Vec<_>>()
        .join("\n")
}
