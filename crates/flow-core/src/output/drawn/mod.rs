//! What picture, page and card draw alike: ranges of values, curves between their nodes, energy over time.

mod digits;
mod energies;
mod range;
mod smooth;

pub(super) use digits::trimmed;
pub(super) use energies::energy_over_time;
pub(super) use range::range;
#[cfg(feature = "picture")]
pub(super) use range::range_of_positions;
pub(super) use smooth::smooth;
