//! The rows of the band.

use super::super::carries;
use super::super::compact_laplacian::{MASS, convolve, neighbours};
use super::LocalPart;
use crate::flow::gradient_flow::GradientFlow;

impl<const F: usize, const B: usize> LocalPart<F, B> {
    /// Stencils of the gradient p = Hess·Aw over the nodes i−1, i, i+1, and of the velocity
    /// AV = Bp₀ + A κΣφp over i−2 … i+2.
    pub(super) fn set_stencils(&mut self, stiffness: &[f64], scale: f64) {
        let nodes = self.grid.nodes();
        for i in 0..nodes {
            let difference = self.difference(i, scale);
            for f in 0..F {
                for k in 0..3 {
                    let mut entries = [0.0; F];
                    for g in 0..F {
                        entries[g] = MASS[k] * self.coefficients.second(i, f, g);
                    }
                    entries[f] -= difference[k] * stiffness[f];
                    self.gradient_rows[i][f][k] = entries;
                }
            }
        }
        for i in 0..nodes {
            let mut stencil = [[0.0; F]; 5];
            let difference = self.difference(i, scale);
            for (shift, node) in neighbours(i, nodes).into_iter().enumerate() {
                let kappa = MASS[shift] * self.coefficients.field(node, 0);
                for f in 0..F {
                    let bend = if f == 0 { difference[shift] } else { 0.0 };
                    let factor = bend + kappa * self.coefficients.field(node, f);
                    for k in 0..3 {
                        for g in 0..F {
                            stencil[shift + k][g] += factor * self.gradient_rows[node][f][k][g];
                        }
                    }
                }
            }
            self.velocity_rows[i] = stencil;
        }
    }

    /// Fills I − γJ for φ = Aw: A²·(κ̇ = −ΔV − κ²V) and A·(ρ̇ = −κρV − 𝓖p).
    pub(super) fn fill(&mut self, flow: &GradientFlow, gamma: f64, scale: f64) {
        let (densities, length) = (flow.density_mobilities(), flow.frozen().length());
        let (carries, nodes) = (carries(flow), self.grid.nodes());
        self.matrix.clear();
        let (square, cube) = (convolve::<3, 5>(&MASS), convolve::<5, 7>(&convolve::<3, 5>(&MASS)));
        for i in 0..nodes {
            for f in 0..F {
                let mut row = [[0.0; F]; 7];
                if f == 0 {
                    for k in 0..7 {
                        row[k][f] = cube[k];
                    }
                    let difference = self.difference(i, scale);
                    for (shift, node) in neighbours(i, nodes).into_iter().enumerate() {
                        let kappa = self.coefficients.field(node, 0);
                        let factor = gamma * (difference[shift] + MASS[shift] * kappa * kappa);
                        for k in 0..5 {
                            for g in 0..F {
                                row[shift + k][g] += factor * self.velocity_rows[node][k][g];
                            }
                        }
                    }
                } else {
                    for k in 0..5 {
                        row[1 + k][f] = square[k];
                    }
                    let carried = if carries { 0.0 } else { self.coefficients.field(i, f) };
                    let damping = gamma * self.coefficients.field(i, 0) * carried;
                    for k in 0..5 {
                        for g in 0..F {
                            row[1 + k][g] += damping * self.velocity_rows[i][k][g];
                        }
                    }
                    let density = &densities[f - 1];
                    let points = density.three_points(i, nodes, length);
                    let weights =
                        if density.order() == 0 { MASS.map(|mass| mass * points[1]) } else { points };
                    for (shift, node) in neighbours(i, nodes).into_iter().enumerate() {
                        let factor = gamma * weights[shift];
                        for k in 0..3 {
                            for g in 0..F {
                                row[1 + shift + k][g] += factor * self.gradient_rows[node][f][k][g];
                            }
                        }
                    }
                }
                self.matrix.set_row(i * F + f, -((3 * F + f) as isize), row.as_flattened());
            }
        }
    }
}
