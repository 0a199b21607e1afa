//! Runs of scenes by each method, and times of their parts.

mod case;
mod clock;
mod costs;
mod generality;
mod interleaved;
mod iterations;
mod method;
mod outcome;

pub use case::{AUXILIARY, Case};
pub use costs::{Costs, SIZES, costs, exponent};
pub use generality::{CALLS, Generality, Steps, calls, clocks, generality};
pub use interleaved::{Times, in_turns};
pub use iterations::{GAMMAS, REDUCTION, SOLVERS, iterations};
pub use method::Method;
pub use outcome::{Outcome, Unfinished};
