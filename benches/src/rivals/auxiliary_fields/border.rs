//! What is global in the system: the length, the means that z and ∂_sW lose, and the values that W and Z start from.
//!
//! Unknowns λ, ζ = ⟨z⟩, η = ∂_t|Γ|, the last Z and the last W; rows: the two left out of the band, ⟨W⟩ = 0, ⟨Z⟩ + π = 0
//! with π = ∂𝓕/∂|Γ| of the motion, and λ − γη/L = r. Eliminated by the Schur complement of the band.

use flow_core::flow::GradientFlow;
use nalgebra::{SMatrix, SVector};

use super::band::Band;
use super::places::Places;
use super::rows::{adjoint_row, minus_second_difference, tangential_row};

/// Number of unknowns in the border.
pub const BORDER: usize = 5;
const LENGTH: usize = 0;
const MEAN_OF_ADJOINT_RATE: usize = 1;
const LENGTH_RATE: usize = 2;
const LAST_ADJOINT: usize = 3;
const LAST_TANGENTIAL: usize = 4;

const ADJOINT_ROW: usize = 0;
const TANGENTIAL_ROW: usize = 1;
const MEAN_TANGENTIAL_ROW: usize = 2;
const MEAN_ADJOINT_ROW: usize = 3;
/// Row of the length, whose right-hand side is not zero.
pub const LENGTH_ROW: usize = 4;

/// Rows, columns and the inverse of the Schur complement.
#[derive(Clone, Debug)]
pub struct Border {
    length: f64,
    /// Entries of the rows in the band's unknowns; the row of the length has none.
    rows: [Vec<f64>; BORDER - 1],
    /// The columns, solved by the band.
    columns: [Vec<f64>; BORDER],
    inverse: SMatrix<f64, BORDER, BORDER>,
}

impl Border {
    /// Room for the unknowns of `places`.
    pub fn new(places: Places) -> Self {
        let zero = vec![0.0; places.unknowns()];
        Self {
            length: 1.0,
            rows: std::array::from_fn(|_| zero.clone()),
            columns: std::array::from_fn(|_| zero.clone()),
            inverse: SMatrix::zeros(),
        }
    }

    /// Length of the frozen curve.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Sets the border at the frozen state of `flow`, whose band is factorised; false if it is singular.
    pub fn set(&mut self, flow: &GradientFlow, places: Places, gamma: f64, band: &mut dyn Band) -> bool {
        self.length = flow.frozen().length();
        self.set_columns(flow, places);
        for column in &mut self.columns {
            band.solve(column);
        }
        let of_length = self.set_rows(flow, places);
        let mut complement = SMatrix::<f64, BORDER, BORDER>::zeros();
        let mean = 1.0 / places.nodes as f64;
        complement[(ADJOINT_ROW, MEAN_OF_ADJOINT_RATE)] = mean;
        complement[(TANGENTIAL_ROW, LENGTH_RATE)] = -mean;
        complement[(MEAN_ADJOINT_ROW, LENGTH)] = of_length;
        complement[(LENGTH_ROW, LENGTH)] = 1.0;
        complement[(LENGTH_ROW, LENGTH_RATE)] = -gamma / self.length;
        for (r, row) in self.rows.iter().enumerate() {
            for (c, column) in self.columns.iter().enumerate() {
                complement[(r, c)] -= dot(row, column);
            }
        }
        complement.try_inverse().map(|inverse| self.inverse = inverse).is_some()
    }

    fn set_columns(&mut self, flow: &GradientFlow, places: Places) {
        let (nodes, square) = (places.nodes, self.length.powi(2));
        let (jet, frozen) = (flow.energy_terms().jet(), flow.frozen());
        let stiffness = flow.energy_terms().stiffness();
        for column in &mut self.columns {
            column.fill(0.0);
        }
        let scale = (nodes as f64).powi(2) / square;
        for node in 0..nodes {
            for field in 0..places.fields {
                let local: f64 = (0..places.fields)
                    .map(|other| jet.second(field, other)[node] * frozen.at_nodes(other)[node])
                    .sum();
                let bent = scale * stiffness[field] * minus_second_difference(frozen.at_nodes(field), node);
                // λ changes φ = x/L by −φλ, and the stiffness c/L² by −2λ of itself.
                self.columns[LENGTH][places.gradient(field, node)] = local + 3.0 * bent;
            }
            let tension = flow.frozen_stretching()[node];
            self.columns[LENGTH][places.velocity(node)] = tension * frozen.at_nodes(0)[node];
            if node + 1 < nodes {
                self.columns[MEAN_OF_ADJOINT_RATE][places.adjoint(node)] = 1.0 / nodes as f64;
                self.columns[LENGTH_RATE][places.tangential(node)] = -1.0 / nodes as f64;
            }
        }
        self.columns[LAST_ADJOINT][places.adjoint(nodes - 1)] = -1.0;
        self.columns[LAST_TANGENTIAL][places.tangential(nodes - 1)] = -1.0;
    }

    /// Sets the rows; returns the entry of π at λ.
    fn set_rows(&mut self, flow: &GradientFlow, places: Places) -> f64 {
        let (nodes, last) = (places.nodes as f64, places.nodes - 1);
        for row in &mut self.rows {
            row.fill(0.0);
        }
        for (column, value) in adjoint_row(flow, places, last) {
            self.rows[ADJOINT_ROW][column] += value;
        }
        for (column, value) in tangential_row(flow, places, last) {
            self.rows[TANGENTIAL_ROW][column] += value;
        }
        let mut of_length = self.length * flow.energy_terms().of_length(self.length).second;
        for node in 0..places.nodes {
            self.rows[MEAN_TANGENTIAL_ROW][places.tangential(node)] = 1.0 / nodes;
            self.rows[MEAN_ADJOINT_ROW][places.adjoint(node)] = 1.0 / nodes;
            for field in 0..places.fields {
                let phi = flow.frozen().at_nodes(field);
                let scale = flow.energy_terms().stiffness()[field] * (nodes / self.length).powi(2);
                let bent = scale * minus_second_difference(phi, node) / nodes;
                of_length += 3.0 * phi[node] * bent;
                self.rows[MEAN_ADJOINT_ROW][places.motion(field, node)] = -2.0 * bent;
                self.rows[MEAN_ADJOINT_ROW][places.gradient(field, node)] = -phi[node] / nodes;
            }
        }
        of_length
    }

    /// Completes the band's solution `x` with the right-hand sides `sides` of the border; returns λ.
    pub fn complete(&self, sides: &[f64; BORDER], x: &mut [f64]) -> f64 {
        let mut right = SVector::<f64, BORDER>::from_column_slice(sides);
        for (side, row) in right.iter_mut().zip(&self.rows) {
            *side -= dot(row, x);
        }
        let values = self.inverse * right;
        for (value, column) in values.iter().zip(&self.columns) {
            super::super::add_scaled(x, -value, column);
        }
        values[LENGTH]
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
