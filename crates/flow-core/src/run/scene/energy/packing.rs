//! `[energy.packing]`: `∫ (ρᵀPρ − 1)²/(2ε) dσ` over all densities.

use nalgebra::DMatrix;
use schemars::JsonSchema;
use serde::Serialize;

use super::{EnergyTable, Start, Term};
use crate::energies;
use crate::run::scene::entry::Entry;
use crate::run::scene::error::{Bound, Fault};
use crate::run::scene::keywords::Within;
use crate::run::scene::section::Section;

/// Parameters of the packing of a blend.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Packing {
    /// P by rows: symmetric, positive definite, one row and one column per density in the order of the scene.
    pub matrix: Vec<Vec<f64>>,
    /// Compressibility ε > 0, in length / energy.
    #[schemars(transform = Within(Bound::Positive))]
    pub epsilon: f64,
}

impl EnergyTable for Packing {
    fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
        let matrix = section.required("matrix", "matrix = [[1.0, 0.5], [0.5, 1.0]], a row for each density");
        let matrix = matrix.and_then(|entry| matrix_of(&entry, densities.len()));
        let epsilon = section.required("epsilon", "epsilon = 0.1");
        let epsilon = epsilon.and_then(|entry| entry.number(Bound::Positive, "try epsilon = 0.1"));
        section.finish();
        Some(Self { matrix: matrix?, epsilon: epsilon? })
    }

    fn term(&self, start: &Start<'_>) -> Term {
        Ok(Box::new(energies::Packing::new(&self.matrix, self.epsilon, start.nodes)))
    }
}

/// A symmetric positive definite matrix with `size` rows.
fn matrix_of(entry: &Entry<'_>, size: usize) -> Option<Vec<Vec<f64>>> {
    if size == 0 {
        entry.fault(Fault::NoDensity { needs: "packs the densities of the scene" });
        return None;
    }
    let rows = rows_of(entry, size, "write one row for each density")?;
    // All rows are read before the first failure counts, so that all are reported.
    let read = |row: &Entry<'_>| {
        let entries = rows_of(row, size, "write one number for each density")?;
        let numbers = entries.iter().map(|entry| entry.number(Bound::Finite, "write an ordinary number"));
        numbers.collect::<Vec<_>>().into_iter().collect::<Option<Vec<f64>>>()
    };
    let matrix = rows.iter().map(read).collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?;
    for (i, row) in matrix.iter().enumerate() {
        for (j, &value) in row.iter().enumerate().take(i) {
            if value != matrix[j][i] {
                rows[i].fault(Fault::NotSymmetric { indices: [i, j], value, other: matrix[j][i] });
                return None;
            }
        }
    }
    let square = DMatrix::from_row_iterator(size, size, matrix.iter().flatten().copied());
    if square.clone().cholesky().is_none() {
        let lowest = square.symmetric_eigenvalues().min();
        entry.fault(Fault::NotPositiveDefinite { lowest });
        return None;
    }
    Some(matrix)
}

/// The entries of a list of `size`.
fn rows_of<'d>(entry: &Entry<'d>, size: usize, remedy: &'static str) -> Option<Vec<Entry<'d>>> {
    let entries = entry.list("a list with one entry for each density")?;
    if entries.len() != size {
        let bound = Bound::Exactly(size as f64);
        entry.fault(Fault::WrongCount { count: entries.len(), bound, remedy });
        return None;
    }
    Some(entries)
}
