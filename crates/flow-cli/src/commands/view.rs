//! `curveflow view OUT`: a finished run as a page for the browser.

use std::path::PathBuf;

use flow_core::output::atomic_file::check_writable;
use flow_core::output::page;

use super::scene_args::with_ending;
use super::so_far::run_so_far;
use crate::error::CliError;
use crate::print;

const MEGABYTE: u64 = 1_000_000;
/// Pages that are larger are slow to load, and some browsers give up.
const LARGE: u64 = 100 * MEGABYTE;

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
    let path = args.output.clone().unwrap_or_else(|| with_ending(&args.out, &["h5"], ".html"));
    check_writable(&path, args.replace)?;
    let record = run_so_far(&args.out)?;
    page::view(&record, &path, args.replace)?;
    let bytes = std::fs::metadata(&path).map_or(0, |file| file.len());
    if let Some(warning) = too_large(bytes, record.frames.len()).filter(|_| !args.quiet) {
        print::talk(&warning);
    }
    if args.quiet { Ok(()) } else { print::data(&path.display().to_string()) }
}

/// What to say of a page that a browser may not load.
fn too_large(bytes: u64, frames: usize) -> Option<String> {
    (bytes > LARGE).then(|| {
        // All but a ten thousandth of it is in the frames.
        let fewer = (frames as u64).saturating_mul(LARGE).div_euclid(bytes).max(2);
        format!(
            "warning: the page takes {} MB, and browsers may not load it: run the scene with fewer frames, such as \
             --set output.frames={fewer}, or with fewer nodes",
            bytes / MEGABYTE
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_pages_are_told_with_what_makes_them_smaller() {
        assert_eq!(too_large(LARGE, 8500), None);
        let warning = too_large(928 * MEGABYTE, 8501).unwrap();
        assert!(warning.contains("928 MB") && warning.contains("output.frames=916,"), "{warning}");
    }
}
