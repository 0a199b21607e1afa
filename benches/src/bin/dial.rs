//! Measures what each tolerance buys on every shipped scene, and writes the table of `benches/README.md`.

use std::fmt::Write;
use std::process::ExitCode;

use curveflow_benches::report::publish;
use flow_core::run::tradeoff::{Ladder, Tradeoff, tradeoff};
use flow_core::run::{Quiet, Scene};

fn main() -> ExitCode {
    let mut table = String::new();
    for (name, text) in Scene::shipped() {
        let measured = Scene::parse(text, name).map_err(|error| error.to_string()).and_then(|scene| {
            tradeoff(&scene, &Ladder::default(), &mut Quiet).map_err(|error| error.to_string())
        });
        match measured {
            Ok(measured) => {
                if table.is_empty() {
                    head(&mut table, &measured);
                }
                print!("{}", lines(&mut table, name, &measured));
            }
            Err(error) => {
                eprintln!("{name}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    publish("dial", &table)
}

fn head(table: &mut String, measured: &Tradeoff) {
    table.push_str("\n| scene | |");
    for row in &measured.rows {
        let _ = write!(table, " {:.0e} |", row.tolerance);
    }
    let _ = writeln!(table, "\n| --- | --- |{}", " ---: |".repeat(measured.rows.len()));
}

/// Three lines: error over tolerance, milliseconds, steps and the most nodes.
fn lines(table: &mut String, name: &str, measured: &Tradeoff) -> String {
    let mut text = String::new();
    for (place, what) in ["error / tolerance", "ms", "steps, nodes"].into_iter().enumerate() {
        let _ = write!(text, "| {} | {what} |", if place == 0 { name } else { "" });
        for row in &measured.rows {
            let _ = match &row.outcome {
                Err(_) => write!(text, " – |"),
                Ok(rung) => match place {
                    0 => write!(text, " {:.2} |", rung.largest_error() / row.tolerance),
                    1 => write!(text, " {:.3} |", 1e3 * rung.seconds),
                    _ => write!(text, " {}, {} |", rung.steps, rung.nodes),
                },
            };
        }
        text.push('\n');
    }
    table.push_str(&text);
    text
}
