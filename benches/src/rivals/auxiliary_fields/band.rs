//! The cyclic band for any number of fields.

use std::fmt::Debug;

use flow_core::operators::CyclicBanded;

use super::places::Places;

/// A cyclic banded matrix, filled row by row.
pub trait Band: Debug {
    /// Sets every entry to zero.
    fn clear(&mut self);
    /// Sets a row from its columns and entries; entries of one column add up.
    fn set_row(&mut self, row: usize, entries: &[(usize, f64)]);
    /// Factorises; false if a pivot vanishes.
    fn factorise(&mut self) -> bool;
    /// Overwrites the right-hand side by the solution.
    fn solve(&mut self, x: &mut [f64]);
}

impl<const B: usize> Band for CyclicBanded<B> {
    fn clear(&mut self) {
        CyclicBanded::clear(self);
    }

    fn set_row(&mut self, row: usize, entries: &[(usize, f64)]) {
        let rows = self.rows();
        // Room for both sides and the diagonal, of constant size on stable Rust.
        let mut values = [[0.0; B]; 3];
        let values = values.as_flattened_mut();
        for (column, value) in entries {
            // B + column − row, the shorter way round.
            values[(column + rows + B - row) % rows] += value;
        }
        CyclicBanded::set_row(self, row, -(B as isize), &values[..=2 * B]);
    }

    fn factorise(&mut self) -> bool {
        CyclicBanded::factorise(self).is_ok()
    }

    fn solve(&mut self, x: &mut [f64]) {
        CyclicBanded::solve(self, x);
    }
}

/// A zero matrix. The curvature's motion, p and V reach each other at the neighbours: two beyond the unknowns of a node.
pub fn build(places: Places) -> Box<dyn Band> {
    let rows = places.unknowns();
    match places.fields {
        1 => Box::new(CyclicBanded::<7>::new(rows)),
        2 => Box::new(CyclicBanded::<9>::new(rows)),
        3 => Box::new(CyclicBanded::<11>::new(rows)),
        fields => panic!("no band for {fields} fields; at most three"),
    }
}
