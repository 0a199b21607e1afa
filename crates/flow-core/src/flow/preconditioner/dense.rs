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
    /// [`FactorisationError`] if the matrix is singular.
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
        if !factors.is_invertible() {
            return Err(FactorisationError { row: 0, pivot: 0.0 });
        }
        self.factors = Some(factors);
        Ok(())
    }

    /// Solves with the factorisation.
    pub fn apply(&self, r: &mut [f64]) {
        let Some(factors) = &self.factors else { return };
        let mut x = DVector::from_column_slice(r);
        factors.solve_mut(&mut x);
        r.copy_from_slice(x.as_slice());
    }
}
