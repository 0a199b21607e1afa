//! Medians of runs that take turns: what disturbs the machine disturbs all of them alike.

/// Median seconds of each of `runs`, which tell their seconds, over `rounds` rounds; the order turns about.
///
/// # Panics
/// If `rounds` is zero.
#[must_use]
pub fn medians<const N: usize>(rounds: usize, runs: [&dyn Fn() -> f64; N]) -> [f64; N] {
    let mut times = [const { Vec::new() }; N];
    for round in 0..rounds {
        for turn in 0..N {
            let run = (round + turn) % N;
            times[run].push(runs[run]());
        }
    }
    times.map(median)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn the_median_forgets_outliers() {
        let calls = Cell::new(0.0);
        let disturbed = || {
            calls.set(calls.get() + 1.0);
            if calls.get() == 2.0 { 100.0 } else { 1.0 }
        };
        assert_eq!(medians(5, [&disturbed, &|| 2.0]), [1.0, 2.0]);
        assert_eq!(calls.get(), 5.0);
    }
}
