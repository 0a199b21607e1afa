//! How many values of N and how many moments the method knows.

/// Most values of N that a prediction goes through.
pub const HIGHEST_ORDER: usize = 6;
/// Moments for polynomials through the value at the prediction and one value more, and for those by other clocks.
pub const MOST_MOMENTS: usize = HIGHEST_ORDER + FOR_CLOCKS;
/// Moments beyond the order that make polynomials in stretched time exact to a part of 1e-6 and less of their highest terms.
pub const FOR_CLOCKS: usize = 4;
