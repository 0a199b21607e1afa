//! `curveflow view OUT`: a finished run as a page for the browser.

use std::path::PathBuf;

use flow_core::output::atomic_file::check_writable;
use flow_core::output::{hdf5_file, page};

use crate::error::CliError;
use crate::print;

/// Make a page that shows a result moving: one HTML file, which needs no network.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Result file of `curveflow run`.
    pub out: PathBuf,
    /// Page to write [default: the result file's name with .html].
    #[arg(short, long, value_name = "OUT.html")]
    pub output: Option<PathBuf>,
    /// Replace an existing page.
    #[arg(long)]
    pub replace: bool,
    /// Do not print the name of the page.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Writes the page and prints its name.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let path = args.output.clone().unwrap_or_else(|| args.out.with_extension("html"));
    check_writable(&path, args.replace)?;
    let record = hdf5_file::read(&args.out)?;
    page::view(&record, &path, args.replace)?;
    if args.quiet { Ok(()) } else { print::data(&path.display().to_string()) }
}
