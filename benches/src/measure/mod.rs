//! Runs of scenes by each method, and times of their parts.

mod case;
mod clock;
mod costs;
mod method;
mod outcome;

pub use case::Case;
pub use costs::{Costs, SIZES, costs, exponent};
pub use method::{AUXILIARY, Method};
pub use outcome::{Outcome, Unfinished};
