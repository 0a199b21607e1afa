//! Densities that exchange with the surroundings and cost at once what stretches the curve. See `THEORY.md`, eq. (O10).
//!
//! Without a cost of slopes their rows are equations at the nodes, whose coupling to the curve, ∂²e, may be of any size. The rows are
//! solved as they are, once while nothing else moves, and again after all else has moved: what is left is of order 1.

use super::super::gradient_flow::GradientFlow;
use crate::geometry::Complex64;
use crate::geometry::vectors::add_scaled;

/// Such densities come first where they would damp a uniform stretching, over γ, by more than this beside the 1 of I − γJ.
const STIFF: f64 = 1.0;

/// Solves the rows of these densities, before and after the other fields.
#[derive(Clone, Debug)]
pub struct StiffExchange {
    fields: Vec<usize>,
    gamma: f64,
    /// Whether they are stiff at the linearisation.
    stiff: bool,
    /// I + γ∂²e at each node as `LDLᵀ`, row by row.
    factors: Vec<f64>,
    /// One value per field and node.
    values: Vec<f64>,
    /// What relaxed while nothing else moved, and what that leaves on the right-hand sides.
    relaxed: Vec<f64>,
    rest: Vec<f64>,
    scratch: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl StiffExchange {
    /// For the densities of `flow`; none if none of them is of this kind, or if nodes are material points.
    #[must_use]
    pub fn of(flow: &GradientFlow) -> Option<Self> {
        let (layout, state) = (flow.layout(), vec![0.0; flow.spectral_layout().len()]);
        let exchanges = |field: &usize| {
            flow.density_mobilities()[field - 1].relaxes() && !flow.energy_terms().may_be_stiff(*field)
        };
        let fields: Vec<usize> = (1..layout.fields()).filter(exchanges).collect();
        let (count, nodes) = (fields.len(), layout.nodes());
        (count > 0 && layout.metric().is_none()).then(|| Self {
            fields,
            gamma: 0.0,
            stiff: false,
            factors: vec![0.0; count * count * nodes],
            values: vec![0.0; count * nodes],
            relaxed: state.clone(),
            rest: state.clone(),
            scratch: state,
            spectrum: vec![Complex64::default(); flow.spectral_layout().modes()],
        })
    }

    /// Takes γ and the second derivatives at the linearisation of `flow`.
    pub fn set(&mut self, flow: &GradientFlow, gamma: f64) {
        self.gamma = gamma;
        let nodes = flow.layout().nodes();
        let damping: f64 = (0..nodes).map(|node| self.stretching_damping(flow, node)).sum();
        self.stiff = gamma * damping > STIFF * nodes as f64;
        if !self.stiff {
            return;
        }
        let count = self.fields.len();
        for (node, block) in self.factors.chunks_exact_mut(count * count).enumerate() {
            for (row, a) in self.fields.iter().enumerate() {
                for (column, b) in self.fields.iter().enumerate() {
                    let unit = if row == column { 1.0 } else { 0.0 };
                    block[row * count + column] =
                        unit + gamma * flow.energy_terms().implicit_second(*a, *b)[node];
                }
            }
            factorise(block, count);
        }
    }

    /// κ² ρ·∂²e ρ at a node: what the densities make of a normal velocity, κρ, costs this, and drives it back.
    fn stretching_damping(&self, flow: &GradientFlow, node: usize) -> f64 {
        let (energy, at) = (flow.energy_terms(), flow.frozen());
        let mut cost = 0.0;
        for a in &self.fields {
            for b in &self.fields {
                cost += at.at_nodes(*a)[node] * energy.implicit_second(*a, *b)[node] * at.at_nodes(*b)[node];
            }
        }
        at.at_nodes(0)[node].powi(2) * cost
    }

    /// Takes from the right-hand side `r` what the densities relax by while nothing else moves, and all that this does.
    pub fn relax(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        if !self.stiff {
            return;
        }
        let layout = flow.spectral_layout();
        self.scratch.copy_from_slice(r);
        flow.carry_densities(&mut self.scratch, -1.0);
        self.relaxed.fill(0.0);
        let mut relaxed = std::mem::take(&mut self.relaxed);
        self.solve_rows(flow, layout.spectra_mut(&mut relaxed));
        self.relaxed = relaxed;
        flow.implicit_product(&self.relaxed, &mut self.scratch);
        add_scaled(r, -1.0, &self.relaxed);
        add_scaled(r, self.gamma, &self.scratch);
        self.rest.copy_from_slice(r);
        flow.carry_densities(&mut self.rest, -1.0);
        // The other fields move as if that was all.
        for field in &self.fields {
            let entries = layout.field(*field);
            add_scaled(&mut r[entries.clone()], -1.0, &self.rest[entries]);
        }
    }

    /// Completes `x`, in which the other fields and the length have moved.
    pub fn complete(&mut self, flow: &mut GradientFlow, x: &mut [f64]) {
        if !self.stiff {
            return;
        }
        let layout = flow.spectral_layout();
        for field in &self.fields {
            x[layout.field(*field)].fill(0.0);
        }
        self.scratch.copy_from_slice(x);
        flow.carry_densities(&mut self.scratch, 1.0);
        flow.spectral_hessian_product(x);
        for field in &self.fields {
            let entries = layout.field(*field);
            add_scaled(&mut self.scratch[entries.clone()], 1.0, &self.rest[entries]);
            let carried = &mut layout.spectra_mut(&mut self.scratch)[layout.spectrum(*field)];
            flow.add_density_rate(*field, self.gamma, carried);
        }
        self.solve_rows(flow, layout.spectra_mut(x));
        add_scaled(x, 1.0, &self.relaxed);
    }

    /// Solves (I + γ∂²e)m = r for the densities, r in the scratch, into the spectra `x`.
    fn solve_rows(&mut self, flow: &mut GradientFlow, x: &mut [Complex64]) {
        let (layout, nodes, count) = (flow.spectral_layout(), flow.layout().nodes(), self.fields.len());
        let r = layout.spectra(&self.scratch);
        for (field, values) in self.fields.iter().zip(self.values.chunks_exact_mut(nodes)) {
            self.spectrum.copy_from_slice(&r[layout.spectrum(*field)]);
            flow.grid_mut().synthesise(&self.spectrum, values);
        }
        for (node, block) in self.factors.chunks_exact(count * count).enumerate() {
            substitute(block, count, &mut self.values[node..], nodes);
        }
        for (field, values) in self.fields.iter().zip(self.values.chunks_exact(nodes)) {
            flow.grid_mut().transform(values, &mut x[layout.spectrum(*field)]);
        }
    }
}

/// `LDLᵀ` in place. Pivots are at least 1, as they are where the cost is convex: what is concave counts as flat.
fn factorise(block: &mut [f64], size: usize) {
    for k in 0..size {
        let pivot = block[k * size + k].max(1.0);
        block[k * size + k] = pivot;
        for row in k + 1..size {
            let factor = block[row * size + k] / pivot;
            for column in k + 1..size {
                block[row * size + column] -= factor * block[k * size + column];
            }
            block[row * size + k] = factor;
        }
    }
}

/// Overwrites the first of the `values` and each `stride`-th after it, `size` in all, by the solution.
fn substitute(block: &[f64], size: usize, values: &mut [f64], stride: usize) {
    for row in 0..size {
        for column in 0..row {
            values[row * stride] -= block[row * size + column] * values[column * stride];
        }
    }
    for row in (0..size).rev() {
        values[row * stride] /= block[row * size + row];
        for column in row + 1..size {
            values[row * stride] -= block[column * size + row] * values[column * stride];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{factorise, substitute};

    /// (5, 3, 1; 3, 4, 2; 1, 2, 3)(1, 1, 2) = (10, 11, 9), and all pivots are above 1.
    #[test]
    fn a_block_is_solved() {
        let mut block = [5.0, 3.0, 1.0, 3.0, 4.0, 2.0, 1.0, 2.0, 3.0];
        let mut values = [10.0, f64::NAN, 11.0, f64::NAN, 9.0];
        factorise(&mut block, 3);
        substitute(&block, 3, &mut values, 2);
        let solution = [values[0], values[2], values[4]];
        for (value, expected) in solution.iter().zip([1.0, 1.0, 2.0]) {
            assert!((value - expected).abs() < 1e-14, "{solution:?}");
        }
    }

    /// −3 counts as 1.
    #[test]
    fn a_concave_cost_counts_as_flat() {
        let (mut block, mut values) = ([-3.0], [2.0]);
        factorise(&mut block, 1);
        substitute(&block, 1, &mut values, 1);
        assert_eq!(values, [2.0]);
    }
}
