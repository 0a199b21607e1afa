//! `curveflow plot OUT`: draw a finished run.

use std::path::PathBuf;

use flow_core::output::atomic_file::check_writable;
use flow_core::output::picture;
use flow_core::run::nodal_polylines;

use super::scene_args::with_ending;
use super::so_far::run_so_far;
use crate::error::CliError;
use crate::print;

/// Draw a result: the final curve, its state, energy and length over time.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Result file of `curveflow run`.
    pub out: PathBuf,
    /// Figure to write, `.png` or `.svg` [default: the result file's name with .png].
    #[arg(short, long, value_name = "PNG|SVG")]
    pub output: Option<PathBuf>,
    /// Density that colours the curve and is drawn against its curvature [default: the first one].
    #[arg(long, value_name = "NAME")]
    pub density: Option<String>,
    /// Replace an existing figure.
    #[arg(long)]
    pub replace: bool,
    /// Do not print the name of the figure.
    #[arg(short, long)]
    pub quiet: bool,
}

/// Draws the figure and prints its name, unless quiet.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let path = args.output.clone().unwrap_or_else(|| with_ending(&args.out, &["h5"], ".png"));
    check_writable(&path, args.replace)?;
    let record = run_so_far(&args.out)?;
    let nodal_lines = nodal_polylines(&record, args.density.as_deref())
        .map(|[preferred_curvature, low, high]| picture::NodalLines { preferred_curvature, low, high });
    let density = args.density.clone();
    let options =
        picture::Options { replace: args.replace, density, nodal_lines, ..picture::Options::default() };
    picture::plot(&record, &path, &options)?;
    if args.quiet { Ok(()) } else { print::data(&path.display().to_string()) }
}
