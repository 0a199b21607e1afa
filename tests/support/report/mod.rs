//! Prints tables in Markdown, or puts them into a document: what the commands that make the tables of `docs` share.

mod update;

use std::process::ExitCode;

/// Name of a table, and what makes it.
pub type Table = (&'static str, fn() -> String);

/// Prints the tables that the arguments of the program name, or all; with `--update PATH` puts all into the document there.
#[must_use]
pub fn command(tables: &[Table]) -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, path] = arguments.as_slice()
        && flag == "--update"
    {
        return match update::update(path, tables) {
            Ok(()) => ExitCode::SUCCESS,
            Err(message) => failure(&message),
        };
    }
    if let Some(unknown) = arguments.iter().find(|name| !tables.iter().any(|(table, _)| table == name)) {
        let names: Vec<_> = tables.iter().map(|(name, _)| *name).collect();
        return failure(&format!("no table {unknown}; the tables are {}", names.join(", ")));
    }
    for (name, table) in tables {
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
#[must_use]
pub fn markdown(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let rule = vec!["---".to_owned(); head.len()];
    [line(&head), line(&rule)]
        .into_iter()
        .chain(rows.iter().map(|row| line(row)))
        .collect::<Vec<_>>()
        .join("\n")
}
