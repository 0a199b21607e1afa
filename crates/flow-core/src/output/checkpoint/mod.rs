//! Checkpoints: all that a run must know to go on in another process, in two files that take turns.

#[cfg(feature = "hdf5")]
mod belonging;
mod encoding;
mod file;
mod format;
mod identity;
mod lock;
mod pair;
mod saving;
#[cfg(feature = "hdf5")]
mod so_far;

#[cfg(feature = "hdf5")]
pub use belonging::check_way;
pub use encoding::encode;
pub use file::{read, write};
pub use format::{Checkpoint, OtherScene, SceneTexts, decode};
pub use identity::Identity;
pub use lock::Lock;
pub use pair::{Found, Pair};
pub use saving::{Ended, Saving, run_saving};
#[cfg(feature = "hdf5")]
pub use so_far::{SoFar, so_far};
