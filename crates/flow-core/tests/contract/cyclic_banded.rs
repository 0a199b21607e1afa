//! The cyclic banded factorisation against dense LU.

use std::f64::consts::TAU;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};
use flow_core::operators::{CyclicBanded, Lane};
use proptest::prelude::*;

use crate::config;
use crate::vectors::{distance, largest, noise};

/// A random cyclic band whose diagonal outweighs the rest of its row by `dominance`.
fn random<const B: usize>(rows: usize, dominance: f64, seed: u64) -> (CyclicBanded<B>, Mat<f64>) {
    let mut banded = CyclicBanded::<B>::new(rows);
    let mut dense = Mat::zeros(rows, rows);
    let entries = noise(seed, rows * (2 * B + 1));
    for row in 0..rows {
        let entries = &entries[row * (2 * B + 1)..(row + 1) * (2 * B + 1)];
        let others: f64 = entries.iter().map(|entry| entry.abs()).sum::<f64>() - entries[B].abs();
        for (k, entry) in entries.iter().enumerate() {
            let offset = k as isize - B as isize;
            let value = if offset == 0 { entry.signum() * dominance * others } else { *entry };
            let column = (row as isize + offset).rem_euclid(rows as isize) as usize;
            banded.set(row, offset, value);
            dense[(row, column)] = value;
        }
    }
    (banded, dense)
}

/// Largest difference between the two solutions, relative to the solution.
fn disagreement<const B: usize>(rows: usize, seed: u64) -> f64 {
    let (mut banded, dense) = random::<B>(rows, 1.1, seed);
    let mut x = noise(!seed, rows);
    let right = Col::from_fn(rows, |i| x[i]);
    banded.factorise().expect("a dominant diagonal");
    banded.solve(&mut x);
    let expected: Vec<f64> = dense.partial_piv_lu().solve(&right).iter().copied().collect();
    distance(&x, &expected) / largest(&expected)
}

proptest! {
    #![proptest_config(config(64))]

    /// Dominance bounds the condition by 1.1/0.1 times the spread of the rows: rounding stays near 1e-14.
    #[test]
    fn solutions_are_those_of_a_dense_factorisation(extra in 0_usize..40, seed: u64) {
        let errors = [
            disagreement::<1>(3 + extra, seed),
            disagreement::<2>(6 + extra, seed),
            disagreement::<3>(9 + extra, seed),
            disagreement::<6>(18 + extra, seed),
        ];
        prop_assert!(largest(&errors) <= 1e-12, "{errors:?}");
    }
}

/// I − c²Δ by second differences, on a mode whose image is known.
#[test]
fn smooth_modes_come_back_to_rounding() {
    for rows in [64, 1024, 4096] {
        let mut matrix = CyclicBanded::<1>::new(rows);
        let scale = (rows as f64 * 0.1).powi(2);
        for row in 0..rows {
            matrix.set(row, -1, -scale);
            matrix.set(row, 0, 1.0 + 2.0 * scale);
            matrix.set(row, 1, -scale);
        }
        matrix.factorise().expect("a definite matrix");
        for mode in [0, 1, 3] {
            let exact: Vec<f64> =
                (0..rows).map(|i| (TAU * (mode * i) as f64 / rows as f64 + 0.3).cos()).collect();
            let symbol = 1.0 + 4.0 * scale * (0.5 * TAU * mode as f64 / rows as f64).sin().powi(2);
            let mut x: Vec<f64> = exact.iter().map(|x| symbol * x).collect();
            matrix.solve(&mut x);
            // The condition 1 + 4c²n² grows with the square of the nodes.
            let bound = 4.0 * f64::EPSILON * (1.0 + 4.0 * scale);
            let error = distance(&x, &exact);
            assert!(error <= bound, "{rows} rows, mode {mode}: {error:.1e} > {bound:.1e}");
        }
    }
}

/// Rows set one by one and rows set in all segments at once, in blocks, are the same matrix; `solve` takes its unknowns block by
/// block.
#[test]
fn rows_can_be_set_in_all_segments_at_once() {
    const B: usize = 3;
    for blocks in [5, 8, 24, 25, 63, 64, 130] {
        let rows = 2 * blocks;
        let (mut by_entries, _) = random::<B>(rows, 1.1, 7);
        let entries = noise(7, rows * (2 * B + 1));
        let mut by_segments = CyclicBanded::<B>::in_blocks(rows, 2);
        let dominant = |row: usize| {
            let mut entries = entries[row * (2 * B + 1)..(row + 1) * (2 * B + 1)].to_vec();
            let others: f64 = entries.iter().map(|entry| entry.abs()).sum::<f64>() - entries[B].abs();
            entries[B] = entries[B].signum() * 1.1 * others;
            entries
        };
        for place in 0..by_segments.places() {
            let of_segments = by_segments
                .first_rows()
                .map(|first| dominant((first + place as isize).rem_euclid(rows as isize) as usize));
            let values: Vec<Lane> =
                (0..=2 * B).map(|k| std::array::from_fn(|lane| of_segments[lane][k])).collect();
            by_segments.set_rows(place, -(B as isize), &values);
        }
        by_entries.factorise().expect("a dominant diagonal");
        by_segments.factorise().expect("a dominant diagonal");
        let right = noise(11, rows);
        let mut expected = right.clone();
        by_entries.solve(&mut expected);
        let by_blocks = |x: &[f64]| -> Vec<f64> {
            [0, 1].iter().flat_map(|part| x[*part..].iter().step_by(2).copied()).collect()
        };
        let mut x = by_blocks(&right);
        by_segments.solve(&mut x);
        let error = distance(&x, &by_blocks(&expected)) / largest(&expected);
        assert!(error <= 1e-13, "{blocks} blocks: {error:.1e}");
    }
}

#[test]
fn a_vanishing_pivot_is_told_with_its_row() {
    let mut matrix = CyclicBanded::<1>::new(8);
    for row in 0..8 {
        matrix.set(row, 0, if row == 3 { 0.0 } else { 1.0 });
    }
    let error = matrix.factorise().expect_err("a row of zeros");
    assert_eq!((error.row, error.pivot), (3, 0.0));
}

#[test]
fn a_cleared_matrix_can_be_filled_again() {
    let (mut banded, _) = random::<2>(20, 1.1, 5);
    banded.factorise().expect("a dominant diagonal");
    banded.clear();
    (0..20).for_each(|row| banded.set(row, 0, 2.0));
    banded.factorise().expect("twice the identity");
    let mut x = noise(1, 20);
    let half: Vec<f64> = x.iter().map(|x| 0.5 * x).collect();
    banded.solve(&mut x);
    assert_eq!(x, half);
}
