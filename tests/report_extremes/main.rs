//! Prints the tables of `docs/extremes.md` in Markdown, measured afresh.
//!
//! `cargo run --release -p curveflow-tests --bin extremes` prints all of them, `-- NAME…` those named;
//! `-- --update docs/extremes.md` puts them into the file, between its marks.

mod tables;

use std::process::ExitCode;

use curveflow_tests::report::{Table, command};

/// All tables, in the order of the document.
const TABLES: [Table; 16] = [
    ("epsilon", tables::epsilon),
    ("delta", tables::delta),
    ("penalty", tables::penalty),
    ("area-penalty", tables::area_penalty),
    ("membrane", tables::membrane),
    ("nodes", tables::nodes),
    ("tolerance", tables::tolerance),
    ("ends", tables::ends),
    ("singular", tables::singular),
    ("ill-posed", tables::ill_posed),
    ("curves", tables::curves),
    ("densities", tables::densities),
    ("scaling", tables::scaling),
    ("round-off", tables::round_off),
    ("sweep", tables::sweep),
    ("long", tables::long),
];

fn main() -> ExitCode {
    command(&TABLES)
}
