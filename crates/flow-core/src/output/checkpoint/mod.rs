//! Checkpoints: all that a run must know to go on in another process, in two files that take turns.

mod file;
mod format;
mod lock;
mod pair;
mod saving;
#[cfg(feature = "hdf5")]
mod so_far;

pub use file::{read, write};
pub use format::{Checkpoint, OtherScene, SceneTexts, decode, encode};
pub use lock::Lock;
pub use pair::{Found, Pair};
pub use saving::{Ended, Saving, run_saving};
#[cfg(feature = "hdf5")]
pub use so_far::{SoFar, so_far};
