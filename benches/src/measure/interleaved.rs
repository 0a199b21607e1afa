//! Times of runs that take turns: what disturbs the machine disturbs all of them alike.

/// Median, and lower decile, of the seconds of each of `runs`, which tell their seconds, over `rounds` rounds; the order turns
/// about. On a machine that others use at the same time the decile is that of the runs that they left alone. Each run finds other
/// holes in the memory: where arrays lie by chance makes a loop up to a twentieth slower or faster.
///
/// # Panics
/// If `rounds` is zero.
#[must_use]
pub fn in_turns<const N: usize>(rounds: usize, runs: [&dyn Fn() -> f64; N]) -> [Times; N] {
    let mut times = [const { Vec::new() }; N];
    for round in 0..rounds {
        for turn in 0..N {
            let run = (round + turn) % N;
            let _rest = holes((N * round + turn) as u64);
            times[run].push(runs[run]());
        }
    }
    times.map(|mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        Times { median: times[times.len() / 2], quiet: times[times.len() / 10] }
    })
}

/// Blocks of memory of many sizes, every other one of which is free again.
fn holes(seed: u64) -> Vec<Vec<u8>> {
    let mut state = seed;
    let mut block = || {
        state = state.wrapping_mul(MULTIPLIER).wrapping_add(1);
        vec![0; (MOST_BYTES * (state >> 48) as usize) >> 16]
    };
    let mut blocks: Vec<Vec<u8>> = (0..2 * HOLES).map(|_| block()).collect();
    let mut kept = false;
    blocks.retain(|_| {
        kept = !kept;
        kept
    });
    blocks
}

/// Number and most bytes of the holes; that of Knuth's congruential numbers.
const HOLES: usize = 200;
const MOST_BYTES: usize = 40_000;
const MULTIPLIER: u64 = 6_364_136_223_846_793_005;

/// Seconds of many runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// The median.
    pub median: f64,
    /// The lower decile.
    pub quiet: f64,
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
        let even = |seconds| Times { median: seconds, quiet: seconds };
        assert_eq!(in_turns(5, [&disturbed, &|| 2.0]), [even(1.0), even(2.0)]);
        assert_eq!(calls.get(), 5.0);
    }
}
