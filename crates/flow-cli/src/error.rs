//! What can go wrong in a command; `main.rs` maps each kind to its exit code.

use std::error::Error;
use std::io;
use std::path::PathBuf;

use flow_core::output::StorageError;
use flow_core::output::page::PageError;
use flow_core::output::picture::PictureError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The arguments do not make sense together.
    #[error("{message}; see `curveflow help`")]
    Usage { message: String },
    /// The scene is not valid.
    #[error("the scene is not valid")]
    InvalidScene { source: Box<dyn Error + Send + Sync> },
    /// The integration failed; the last good state is in the output.
    #[error("{message}; the last good state is in {}", .output.display())]
    Numerical { message: String, output: PathBuf },
    /// A file could not be written, or not be read at all.
    #[error(transparent)]
    Storage(StorageError),
    /// Standard output is closed or full.
    #[error("cannot write to standard output: {0}; redirect it to a disk with space")]
    Stdout(io::Error),
    /// The handlers of signals could not be set.
    #[error("cannot watch for signals: {0}")]
    Signals(io::Error),
    /// A signal or a limit stopped the run.
    #[error("stopped at t = {time:.6e} by a signal; the run up to there is in {}", .output.display())]
    Stopped { time: f64, output: PathBuf },
    /// The file to be read is not ours, or damaged.
    #[error(transparent)]
    Unreadable(StorageError),
}

impl From<StorageError> for CliError {
    fn from(error: StorageError) -> Self {
        if error.is_unreadable_file() { Self::Unreadable(error) } else { Self::Storage(error) }
    }
}

impl From<PictureError> for CliError {
    fn from(error: PictureError) -> Self {
        match error {
            PictureError::Storage(error) => error.into(),
            other => Self::Usage { message: other.to_string() },
        }
    }
}

impl From<PageError> for CliError {
    fn from(error: PageError) -> Self {
        match error {
            PageError::Storage(error) => error.into(),
            other => Self::Usage { message: other.to_string() },
        }
    }
}
