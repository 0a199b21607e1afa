//! Measures the parts of a step, a step and a solve against the number of nodes, and writes the table of `benches/README.md`.

use std::process::ExitCode;

use curveflow_benches::measure::{SIZES, costs};
use curveflow_benches::report::{costs_table, publish};

fn main() -> ExitCode {
    let table = costs_table(&SIZES.map(costs));
    print!("{table}");
    publish("scaling", &table)
}
