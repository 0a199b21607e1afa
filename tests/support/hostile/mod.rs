//! Input from strangers, for each reader of the program: what a fuzzer runs, and what `tests/hostile` replays.
//!
//! Each function takes any bytes. It returns if they were used, or refused by a typed error with a message that can be
//! shown; it panics if the program breaks its word.

mod checkpoint;
mod curve_points;
mod expression;
mod overrides;
mod scene;
mod short_run;

pub use checkpoint::{checkpoint, checkpoints, mended};
pub use curve_points::curve_points;
pub use expression::expression;
pub use overrides::overrides;
pub use scene::scene;
pub use short_run::short_run;

/// Longest message that is still read.
const LONGEST_MESSAGE: usize = 20_000;

/// A message says something, in lines of printable characters.
fn check_message(error: &impl std::error::Error) {
    let message = error.to_string();
    assert!(
        !message.is_empty() && message.len() < LONGEST_MESSAGE,
        "{} bytes: {message:.200}",
        message.len()
    );
    assert!(!message.chars().any(|c| c.is_control() && c != '\n'), "{message:?}");
}
