//! Measures what the core costs beside a solver for bending alone, and what its clocks cost; writes the tables of
//! `benches/README.md`.

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;

use curveflow_benches::measure::{clocks, generality};
use curveflow_benches::report::replace_between;

const SIZES: [usize; 5] = [64, 128, 256, 512, 1024];
const CLOCKED: [&str; 3] = ["length_penalty", "three_fold", "adhesion"];
const ROUNDS: usize = 101;

fn main() -> ExitCode {
    let mut tables = String::from(
        "\n| nodes | steps | stripped, ms | core, ms | program, ms | core / stripped | program / stripped | same bits |\n\
         | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
    );
    for nodes in SIZES {
        let measured = generality(nodes, ROUNDS);
        let (base, core, program) = (measured.stripped, measured.core, measured.program);
        let same = if measured.same_bits { "yes" } else { "no" };
        let steps = measured.steps;
        let _ = writeln!(
            tables,
            "| {nodes} | {steps} | {:.3} | {:.3} | {:.3} | {:.3} | {:.3} | {same} |",
            1e3 * base,
            1e3 * core,
            1e3 * program,
            core / base,
            program / base
        );
    }
    tables.push_str(
        "\n| scene | without clocks, ms | with clocks, ms | ratio |\n| --- | ---: | ---: | ---: |\n",
    );
    for scene in CLOCKED {
        let [without, with] = clocks(scene, ROUNDS);
        let _ = writeln!(
            tables,
            "| {scene} | {:.3} | {:.3} | {:.4} |",
            1e3 * without,
            1e3 * with,
            with / without
        );
    }
    print!("{tables}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let written = std::fs::read_to_string(&path).and_then(|document| {
        let document = replace_between(&document, "generality", &tables)
            .ok_or_else(|| std::io::Error::other("the markers of the tables are missing"))?;
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
