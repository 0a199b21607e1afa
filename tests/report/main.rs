//! Prints the tables of `docs/physics.md` in Markdown, measured afresh.
//!
//! `cargo run --release -p curveflow-tests --bin physics` prints all of them, `-- NAME…` those named;
//! `-- --update docs/physics.md` puts them into the file, between its marks.

mod limit;
mod positions;

use std::process::ExitCode;

use curveflow_tests::report::{Table, command};

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
    command(&TABLES)
}
