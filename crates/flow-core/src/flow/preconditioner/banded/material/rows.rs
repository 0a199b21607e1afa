//! The rows of the band, from the second variation of the energy on material points:
//! `∫ δφ·e″δφ + c(∇_sδφ − λ∇_sφ)² + 2cλΔ_sφ δφ dσ`, with the stretch λ = κv.

use super::super::compact_laplacian::neighbours;
use super::super::reach::gamma_of_motion;
use super::{MaterialPart, Row};
use crate::flow::gradient_flow::GradientFlow;

impl<const F: usize, const B: usize> MaterialPart<F, B> {
    /// Weights of `Δ_s` at node `i`.
    fn laplacian(&self, i: usize) -> [f64; 3] {
        let scale = (self.window.grid.nodes() as f64 / self.length).powi(2);
        self.local.differences[i].map(|weight| scale * weight)
    }

    /// Weights of −(`Δ_s` + κ²) at node `i`: the motion of the curvature.
    fn bend(&self, i: usize) -> [f64; 3] {
        let [left, own, right] = self.laplacian(i);
        [-left, -own - self.coefficients.field(i, 0).powi(2), -right]
    }

    /// Arc length that belongs to node `i`, and that from it to the next one.
    fn lengths(&self, i: usize) -> [f64; 2] {
        let (inverse, scale) = (self.local.inverse[i], self.length / self.window.grid.nodes() as f64);
        [scale * self.local.weight[i], scale * inverse / self.local.differences[i][2]]
    }

    pub(super) fn set_stencils(&mut self, costs: &[[f64; F]; F]) {
        for i in 0..self.window.grid.nodes() {
            self.motion_rows[i] = self.motion(i);
        }
        for i in 0..self.window.grid.nodes() {
            self.slope_rows[i] = std::array::from_fn(|f| self.slope(i, f));
        }
        for i in 0..self.window.grid.nodes() {
            (self.gradient_rows[i], self.stretch_rows[i]) = self.gradient(i, costs);
        }
    }

    /// (δκ, δρ) at node `i`.
    fn motion(&self, i: usize) -> [[Row<F>; 3]; F] {
        let (bend, kappa) = (self.bend(i), self.coefficients.field(i, 0));
        let mut motion = [[[0.0; F]; 3]; F];
        for k in 0..3 {
            motion[0][k][0] = bend[k];
        }
        for f in 1..F {
            motion[f][1][0] = -kappa * self.coefficients.field(i, f);
            motion[f][1][f] = 1.0;
        }
        motion
    }

    /// Slope of field `f` from node `i` to the next one.
    fn slope_of(&self, i: usize, f: usize) -> f64 {
        let next = (i + 1) % self.window.grid.nodes();
        (self.coefficients.field(next, f) - self.coefficients.field(i, f)) / self.lengths(i)[1]
    }

    /// ∇_sδφ − λ∇_sφ of field `f` between node `i` and the next one, over the nodes i−1 … i+2.
    fn slope(&self, i: usize, f: usize) -> [Row<F>; 4] {
        let next = (i + 1) % self.window.grid.nodes();
        let (inverse, half) = (1.0 / self.lengths(i)[1], 0.5 * self.slope_of(i, f));
        let mut slope = [[0.0; F]; 4];
        for k in 0..3 {
            for h in 0..F {
                slope[k][h] -= inverse * self.motion_rows[i][f][k][h];
                slope[1 + k][h] += inverse * self.motion_rows[next][f][k][h];
            }
        }
        slope[1][0] -= half * self.coefficients.field(i, 0);
        slope[2][0] -= half * self.coefficients.field(next, 0);
        slope
    }

    /// Derivatives of half the second variation by δφ at node `i`, and by λ.
    fn gradient(&self, i: usize, costs: &[[f64; F]; F]) -> ([[Row<F>; 5]; F], [Row<F>; 5]) {
        let before = neighbours(i, self.window.grid.nodes())[0];
        let (own, kappa) = (self.lengths(i)[0], self.coefficients.field(i, 0));
        let (mut gradient, mut stretch) = ([[[0.0; F]; 5]; F], [[0.0; F]; 5]);
        for f in 0..F {
            let [left, right] = [before, i].map(|j| self.slope_of(j, f) * self.lengths(j)[1]);
            let change = |g: usize| costs[f][g] * (self.slope_of(i, g) - self.slope_of(before, g)) / own;
            let curved: f64 = (0..F).filter(|g| costs[f][*g] != 0.0).map(change).sum();
            gradient[f][2][0] += curved * kappa;
            for h in 0..F {
                for k in 0..4 {
                    let cost = |j: usize, g: usize| costs[f][g] / own * self.slope_rows[j][g][k][h];
                    let [ahead, behind] = [i, before]
                        .map(|j| (0..F).filter(|g| costs[f][*g] != 0.0).map(|g| cost(j, g)).sum::<f64>());
                    gradient[f][1 + k][h] -= ahead;
                    gradient[f][k][h] += behind;
                    stretch[1 + k][h] -= 0.5 * right * ahead;
                    stretch[k][h] -= 0.5 * left * behind;
                }
                for k in 0..3 {
                    for g in 0..F {
                        let second = self.coefficients.second(i, f, g);
                        gradient[f][1 + k][h] += second * self.motion_rows[i][g][k][h];
                    }
                    stretch[1 + k][h] += curved * self.motion_rows[i][f][k][h];
                }
            }
        }
        (gradient, stretch)
    }

    /// Fills I + γ(𝓑Bᵀp for v, 𝓖p for ν), with 𝓑 that of surface diffusion or Id, or zero where the curve is held.
    pub(super) fn fill(&mut self, flow: &GradientFlow, gamma: f64) {
        let (densities, nodes) = (flow.density_mobilities(), self.window.grid.nodes());
        for i in 0..nodes {
            self.force_rows[i] = self.force(i);
        }
        self.matrix.clear();
        for i in 0..nodes {
            if self.is_surface_diffusion {
                let mut row = [[0.0; F]; 9];
                row[4][0] = 1.0;
                for (shift, node) in neighbours(i, nodes).into_iter().enumerate() {
                    add(&mut row, shift, -gamma * self.laplacian(i)[shift], &self.force_rows[node]);
                }
                self.matrix.set_row(i * F, -((4 * F) as isize), row.as_flattened());
            } else {
                let mut row = [[0.0; F]; 7];
                row[3][0] = 1.0;
                add(&mut row, 0, gamma_of_motion(flow, gamma), &self.force_rows[i]);
                self.matrix.set_row(i * F, -((3 * F) as isize), row.as_flattened());
            }
            for f in 1..F {
                let mut row = [[0.0; F]; 7];
                row[3][f] = 1.0;
                let weights = densities[f - 1].three_points(flow.frozen(), i, nodes);
                for (shift, node) in neighbours(i, nodes).into_iter().enumerate() {
                    add(&mut row, shift, gamma * weights[shift], &self.gradient_rows[node][f]);
                }
                self.matrix.set_row(i * F + f, -((3 * F + f) as isize), row.as_flattened());
            }
        }
    }

    /// Bᵀp for v at node `i`, over the nodes i−3 … i+3.
    fn force(&self, i: usize) -> [Row<F>; 7] {
        let (mut row, kappa, weights) = ([[0.0; F]; 7], self.coefficients.field(i, 0), self.bend(i));
        for (shift, node) in neighbours(i, self.window.grid.nodes()).into_iter().enumerate() {
            add(&mut row, shift, weights[shift], &self.gradient_rows[node][0]);
        }
        add(&mut row, 1, kappa, &self.stretch_rows[i]);
        for k in 0..3 {
            row[2 + k][0] -= self.stretching[i] * weights[k];
        }
        for g in 1..F {
            add(&mut row, 1, -kappa * self.coefficients.field(i, g), &self.gradient_rows[i][g]);
        }
        row
    }
}

/// Adds `factor` × `stencil`, from the place `first` on.
fn add<const F: usize>(row: &mut [Row<F>], first: usize, factor: f64, stencil: &[Row<F>]) {
    for (target, entries) in row[first..].iter_mut().zip(stencil) {
        for (target, entry) in target.iter_mut().zip(entries) {
            *target += factor * entry;
        }
    }
}
