//! Measures what the core costs beside a solver for bending alone, and what its clocks cost; writes the tables of
//! `benches/README.md`.

use std::fmt::Write;
use std::process::ExitCode;

use curveflow_benches::measure::{CALLS, Steps, Times, calls, clocks, generality};
use curveflow_benches::report::publish;

const SIZES: [usize; 5] = [64, 128, 256, 512, 1024];
const CALLED_ON: usize = 256;
const CLOCKED: [&str; 3] = ["length_penalty", "three_fold", "adhesion"];
const ROUNDS: usize = 101;

fn main() -> ExitCode {
    let mut tables = String::new();
    for table in [implicit_table, exponential_table, calls_table, clocks_table] {
        let text = table();
        print!("{text}");
        tables.push_str(&text);
    }
    publish("generality", &tables)
}

fn implicit_table() -> String {
    generality_table("Implicit steps:", Steps::Implicit)
}

fn exponential_table() -> String {
    generality_table("Exponential steps:", Steps::Exponential)
}

fn generality_table(title: &str, steps: Steps) -> String {
    let mut table = format!(
        "\n{title}\n\n| nodes | steps | stripped, ms | core, ms | program, ms | core / stripped | program / stripped | same bits |\n\
         | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
    );
    for nodes in SIZES {
        let measured = generality(steps, nodes, ROUNDS);
        let (base, core, program) = (measured.stripped, measured.core, measured.program);
        let times = [base, core, program].map(milliseconds).join(" | ");
        let ratios = [core, program].map(|times| ratio(times, base)).join(" | ");
        let same = if measured.same_bits { "yes" } else { "no" };
        let _ = writeln!(table, "| {nodes} | {} | {times} | {ratios} | {same} |", measured.steps);
    }
    table
}

fn calls_table() -> String {
    let mut table =
        format!("\n| one call on {CALLED_ON} nodes | stripped, µs | core, µs |\n| --- | ---: | ---: |\n");
    let [stripped, core] = calls(CALLED_ON);
    for ((name, stripped), core) in CALLS.into_iter().zip(stripped).zip(core) {
        let _ = writeln!(table, "| {name} | {:.2} | {:.2} |", 1e6 * stripped, 1e6 * core);
    }
    table
}

fn clocks_table() -> String {
    let mut table = String::from(
        "\n| scene | without clocks, ms | with clocks, ms | ratio |\n| --- | ---: | ---: | ---: |\n",
    );
    for scene in CLOCKED {
        let [without, with] = clocks(scene, ROUNDS);
        let times = [without, with].map(milliseconds).join(" | ");
        let _ = writeln!(table, "| {scene} | {times} | {} |", ratio(with, without));
    }
    table
}

/// Median, and lower decile in brackets.
fn milliseconds(times: Times) -> String {
    format!("{:.3} ({:.3})", 1e3 * times.median, 1e3 * times.quiet)
}

fn ratio(times: Times, base: Times) -> String {
    format!("{:.3} ({:.3})", times.median / base.median, times.quiet / base.quiet)
}
