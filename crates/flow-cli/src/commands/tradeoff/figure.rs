//! The figure of a ladder: whether there is to be one, and where.

use std::path::{Path, PathBuf};

use flow_core::output::atomic_file::check_writable;
use flow_core::output::picture;
use flow_core::run::tradeoff::Tradeoff;

use crate::error::CliError;

/// Which figure to write.
#[derive(Debug, clap::Args)]
pub struct FigureArgs {
    /// Figure to write, `.png` or `.svg` [default: the scene's name with _tradeoff.png, in the current folder; none with --json].
    #[arg(short, long, value_name = "PNG|SVG")]
    pub output: Option<PathBuf>,
    /// Write no figure.
    #[arg(long, conflicts_with_all = ["output", "replace"])]
    pub no_picture: bool,
    /// Replace an existing figure.
    #[arg(long)]
    pub replace: bool,
}

impl FigureArgs {
    /// The figure that is to be written, if any, `default` unless another is named: it can be written. A program that reads JSON has
    /// not asked for one unless it names it.
    pub fn path(&self, default: PathBuf, json: bool) -> Result<Option<PathBuf>, CliError> {
        let path = self.output.clone().or_else(|| (!json && !self.no_picture).then_some(default));
        if let Some(path) = &path {
            picture::check_name(path)?;
            check_writable(path, self.replace)?;
        }
        Ok(path)
    }

    /// Draws `measured` into the file `path`.
    pub fn draw(&self, measured: &Tradeoff, path: &Path) -> Result<(), CliError> {
        let options = picture::Options { replace: self.replace, ..picture::Options::default() };
        Ok(picture::plot_tradeoff(measured, path, &options)?)
    }
}
