//! The range of values that an axis or a bar of colours shows.

/// What varies by less than this part of its size is constant: the rest is rounding, and would fill the axis.
const CONSTANT: f64 = 1e-6;
/// Positions mean something down to this part of their size: a curve may lie far from the origin.
#[cfg(feature = "picture")]
const SAME_PLACE: f64 = 1e-12;
/// Room on both sides of a constant, in parts of its size.
const AROUND_CONSTANT: f64 = 0.05;

/// Smallest and largest finite value; around a constant some room, so that they are never equal.
pub(in crate::output) fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    apart(values, CONSTANT)
}

/// As [`range`], for coordinates.
#[cfg(feature = "picture")]
pub(in crate::output) fn range_of_positions(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    apart(values, SAME_PLACE)
}

fn apart(values: impl IntoIterator<Item = f64>, constant: f64) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let (low, high) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    if high - low > constant * size {
        (low, high)
    } else {
        let half = if size > 0.0 { AROUND_CONSTANT * size } else { 1.0 };
        (low - half, high + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_and_missing_data_have_a_range() {
        assert_eq!(range([2.0, 2.0]), (1.9, 2.1));
        assert_eq!(range([f64::NAN]), (0.0, 1.0));
        assert_eq!(range([0.0]), (-1.0, 1.0));
    }

    #[cfg(feature = "picture")]
    #[test]
    fn a_curve_far_from_the_origin_has_its_own_range() {
        assert_eq!(range_of_positions([1e8 - 1.0, 1e8 + 1.0]), (1e8 - 1.0, 1e8 + 1.0));
        assert_eq!(range_of_positions([2.0, 2.0]), (1.9, 2.1));
    }
}
