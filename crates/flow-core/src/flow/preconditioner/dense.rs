//! Dense LU of the exact I − γJ, column by column: for few nodes, and as a reference.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::super::gradient_flow::GradientFlow;
use crate::geometry::SpectralLayout;
use crate::operators::FactorisationError;

/// The factorisation.
#[derive(Clone, Debug)]
pub struct Dense {
    size: usize,
    factors: Option<LU<f64, Dyn, Dyn>>,
}

impl Dense {
    /// Room for one factorisation.
    #[must_use]
    pub fn new(layout: SpectralLayout) -> Self {
        Self { size: layout.len(), factors: None }
    }

    /// Assembles and factorises I − γJ at the frozen state.
    ///
    /// # Errors
    /// [`FactorisationError`] if the matrix is singular: its smallest pivot, and the row of that.
    pub fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError> {
        self.factors = None; // there is room for one matrix
        let mut matrix = DMatrix::identity(self.size, self.size);
        let (mut unit, mut product) = (vec![0.0; self.size], vec![0.0; self.size]);
        for column in 0..self.size {
            unit[column] = 1.0;
            flow.implicit_product(&unit, &mut product);
            unit[column] = 0.0;
            for row in 0..self.size {
                matrix[(row, column)] -= gamma * product[row];
            }
        }
        let factors = matrix.lu();
        let pivots = factors.lu_internal().diagonal();
        let row = pivots.iamin();
        let pivot: f64 = pivots[row];
        if pivot == 0.0 || !pivot.is_finite() {
            return Err(FactorisationError { row, pivot });
        }
        self.factors = Some(factors);
        Ok(())
    }

    /// Solves with the factorisation.
    ///
    /// # Panics
    /// If none is held: before [`Dense::factorise`], and after one that failed.
    pub fn apply(&self, r: &mut [f64]) {
        let mut x = DVector::from_column_slice(r);
        self.factors.as_ref().expect("a factorisation is held").solve_mut(&mut x);
        r.copy_from_slice(x.as_slice());
    }
}
