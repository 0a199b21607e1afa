//! Checkpoints: all that a run must know to go on in another process, in two files that take turns.

mod format;
mod lock;
mod pair;
mod saving;

pub use format::{Checkpoint, SceneTexts, decode, encode};
pub use lock::Lock;
pub use pair::{Found, Pair, read};
pub use saving::{Ended, Saving, run_saving};
