//! What can go wrong in a command; `lib.rs` maps each kind to its exit code.

use std::error::Error;
use std::io;
use std::path::PathBuf;

use flow_core::output::StorageError;
use flow_core::output::page::PageError;
use flow_core::output::picture::PictureError;
use flow_core::run::SetupError;
use flow_core::run::tradeoff::TradeoffError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The arguments do not make sense together.
    #[error("{message}; see `curveflow help`")]
    Usage { message: String },
    /// The scene is not valid; each problem names its line or its key.
    #[error(transparent)]
    InvalidScene(Box<dyn Error + Send + Sync>),
    /// The scene reads well, but its curve, densities and energy make no initial state.
    #[error("{}: {reason}", .scene.display())]
    Unusable { scene: PathBuf, reason: SetupError },
    /// The integration failed; the last good state is in the output.
    #[error("{message}; the last good state is in {}", .output.display())]
    Numerical { message: String, output: PathBuf },
    /// The steps that the scene allows are used up; the run can go on if it allows more.
    #[error(
        "{message}; the run up to there is in {0}, and goes on by `curveflow run --resume -o {0}` with the scene that allows more",
        .output.display()
    )]
    UsedUp { message: String, output: PathBuf },
    /// A ladder of tolerances has nothing to be measured against.
    #[error(transparent)]
    Unmeasured(TradeoffError),
    /// No run of a ladder reached its end.
    #[error("every run of the ladder failed, each as the table says; try other tolerances")]
    AllFailed,
    /// No run of a ladder is as good as asked.
    #[error(
        "no run has an error of {asked:e} or less: the smallest is {least:.1e}, at tolerance {tolerance:e}; add tighter \
         tolerances, or, if tolerances do not help, nodes"
    )]
    NotReached { asked: f64, least: f64, tolerance: f64 },
    /// A file could not be written, or not be read at all.
    #[error(transparent)]
    Storage(StorageError),
    /// The result could not be written; its run has a checkpoint.
    #[error("{reason}; the run is not lost: after that, `curveflow resume {0}` goes on from its checkpoint", .output.display())]
    Unwritten { reason: StorageError, output: PathBuf },
    /// Neither the result nor a checkpoint of its run could be written.
    #[error("{0}; a checkpoint of the run could not be written either, so that nothing of it is kept")]
    Lost(StorageError),
    /// Standard output is full, or cannot be written to for another reason than that its reader has gone.
    #[error("cannot write to standard output: {0}; redirect it to a disk with space")]
    Stdout(io::Error),
    /// The handlers of signals could not be set.
    #[error("cannot watch for signals: {0}")]
    Signals(io::Error),
    /// A signal or a limit stopped the run.
    #[error(
        "stopped at t = {time:.6e} by a signal or --max-wall; the run up to there is in {0}; go on with `curveflow resume \
         {0}`", .output.display()
    )]
    Stopped { time: f64, output: PathBuf },
    /// The checkpoint, or the finished result, is of another scene.
    #[error(
        "{}: the run that is there is of another scene{}; if it was stopped, go on with it by `curveflow resume`, or start anew with \
         --replace", .output.display(), difference(.key.as_deref())
    )]
    OtherScene { output: PathBuf, key: Option<String> },
    /// The run of a result had terms that no scene holds.
    #[error(
        "{}: the run had energy terms from outside its scene (`{}`), which this program does not have, and its scene alone is another \
         run; run it by the program that made it", .result.display(), .terms.join("`, `")
    )]
    OwnTerms { result: PathBuf, terms: Vec<String> },
    /// A signal stopped a ladder.
    #[error("stopped by a signal after {measured} of the runs; try fewer tolerances, or looser ones")]
    LadderStopped { measured: usize },
    /// The file to be read is not ours, or damaged.
    #[error(transparent)]
    Unreadable(StorageError),
}

/// In what the scenes of a run and of a command differ, if that is known.
fn difference(key: Option<&str>) -> String {
    match key {
        // What people would change to make a run longer.
        Some("time.end") => ", whose `time.end` is another one (frames and steps depend on the end from the start, so that this is \
                             another run)"
            .to_owned(),
        Some(key) => format!(", which differs in `{key}`"),
        None => String::new(),
    }
}

impl From<StorageError> for CliError {
    fn from(error: StorageError) -> Self {
        if error.is_unreadable_file() { Self::Unreadable(error) } else { Self::Storage(error) }
    }
}

impl From<TradeoffError> for CliError {
    fn from(error: TradeoffError) -> Self {
        match error {
            TradeoffError::Setup(error) => Self::InvalidScene(Box::new(error)),
            TradeoffError::FewerNodes { .. } => Self::Usage { message: error.to_string() },
            TradeoffError::Interrupted => Self::LadderStopped { measured: 0 },
            other => Self::Unmeasured(other),
        }
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
