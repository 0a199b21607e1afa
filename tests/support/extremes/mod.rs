//! Scenes at the ends of every range that a scene may have: each succeeds with its laws intact, or stops with the error
//! that says why and keeps the last good state. `tests/extremes` asserts it, `docs/extremes.md` shows it.

pub mod case;
pub mod data;
pub mod outcome;
pub mod parameters;
pub mod round_off;
pub mod scaling;
pub mod sweep;
pub mod times;

pub use case::{Case, Size};
pub use outcome::{End, Outcome};
