//! The rows of the band, those at one place of all segments at once.

#![allow(clippy::inline_always)] // these bodies must be compiled inside each version of the loops

use multiversion::multiversion;

use super::super::super::motion::carries;
use super::super::compact_laplacian::{DIFFERENCE, MASS, power_of_mass};
use super::super::reach::gamma_of_motion;
use super::LocalPart;
use crate::flow::gradient_flow::GradientFlow;
use crate::operators::{CyclicBanded, LANES, Lane};

/// Nodes beyond each end of the segments that their rows see: one for each Laplacian but the last.
fn margin(is_surface_diffusion: bool) -> usize {
    if is_surface_diffusion { 3 } else { 2 }
}

/// What the rows take of one node of each segment.
#[derive(Clone, Copy, Debug)]
pub struct Node<const F: usize> {
    fields: [Lane; F],
    second: [[Lane; F]; F],
    /// Weights of `Δ_s` before the division by A.
    difference: [Lane; 3],
    /// Those of the mobility of each density, by its field.
    mobility: [[Lane; 3]; F],
}

/// Coefficients of all `F` fields.
type Row<const F: usize> = [Lane; F];

/// Stencils of the gradient p = Hess·Aw over the nodes i−1, i, i+1.
type Gradient<const F: usize> = [[Row<F>; 3]; F];

/// Stencil of the force Af = Bp₀ + A κΣφp over i−2 … i+2.
type Force<const F: usize> = [Row<F>; 5];

/// Stencil of the velocity of surface diffusion A²V = −B(Af) over i−3 … i+3.
type Diffused<const F: usize> = [Row<F>; 7];

/// Scratch of the assembly.
#[derive(Debug)]
pub struct Stencils<const F: usize> {
    nodes: Vec<Node<F>>,
    gradients: Vec<Gradient<F>>,
    forces: Vec<Force<F>>,
    /// None where V = f.
    diffused: Vec<Diffused<F>>,
}

impl<const F: usize> Stencils<F> {
    /// For the rows of `nodes` nodes in each segment.
    pub fn new(nodes: usize, is_surface_diffusion: bool) -> Self {
        let margin = margin(is_surface_diffusion);
        let zero = [0.0; LANES];
        let node = Node {
            fields: [zero; F],
            second: [[zero; F]; F],
            difference: [zero; 3],
            mobility: [[zero; 3]; F],
        };
        Self {
            nodes: vec![node; nodes + 2 * margin],
            gradients: vec![[[[zero; F]; 3]; F]; nodes + 2 * margin],
            forces: vec![[[zero; F]; 5]; nodes + 2 * (margin - 1)],
            diffused: vec![[[zero; F]; 7]; if is_surface_diffusion { nodes + 2 } else { 0 }],
        }
    }
}

impl<const F: usize, const B: usize> LocalPart<F, B> {
    /// Fills I − γJ for φ = Aw: A²·(κ̇ = −ΔV − κ²V) and A·(ρ̇ = −κρV − 𝓖p), both with a further A for surface diffusion.
    pub(super) fn fill(&mut self, flow: &mut GradientFlow, gamma: f64, scale: f64) {
        self.take_nodes(flow, scale);
        self.matrix.clear();
        let Stencils { nodes, gradients, forces, diffused } = &mut self.stencils;
        set_gradients(nodes, &flow.energy_terms().implicit_costs(), gradients);
        set_forces(nodes, gradients, forces);
        let factors = (gamma, gamma_of_motion(flow, gamma), carries(flow));
        if self.is_surface_diffusion {
            diffuse(nodes, forces, diffused);
            set_rows::<F, B, 7, 9, 3>(nodes, (gradients, diffused), factors, &MASS, &mut self.matrix);
        } else {
            set_rows::<F, B, 5, 7, 1>(nodes, (gradients, forces), factors, &[1.0], &mut self.matrix);
        }
    }

    fn take_nodes(&mut self, flow: &GradientFlow, scale: f64) {
        let (nodes, at) = (self.window.grid.nodes(), flow.frozen());
        let margin = margin(self.is_surface_diffusion) as isize;
        let firsts = self.matrix.first_rows().map(|row| row / F as isize - margin);
        for (place, node) in self.stencils.nodes.iter_mut().enumerate() {
            for lane in 0..LANES {
                let i = (firsts[lane] + place as isize).rem_euclid(nodes as isize) as usize;
                for f in 0..F {
                    node.fields[f][lane] = self.coefficients.field(i, f);
                    for g in 0..F {
                        node.second[f][g][lane] = self.coefficients.second(i, f, g);
                    }
                }
                let difference = self.local.as_ref().map_or(DIFFERENCE, |local| local.differences[i]);
                for (target, weight) in node.difference.iter_mut().zip(difference) {
                    target[lane] = scale * weight;
                }
                for (mobility, density) in node.mobility[1..].iter_mut().zip(flow.density_mobilities()) {
                    let points = density.three_points(at, i, nodes);
                    let weights =
                        if density.order() == 0 { MASS.map(|mass| mass * points[1]) } else { points };
                    for (target, weight) in mobility.iter_mut().zip(weights) {
                        target[lane] = weight;
                    }
                }
            }
        }
    }
}

/// a += b c, lane by lane.
#[inline(always)]
fn add_product(a: &mut Lane, b: &Lane, c: &Lane) {
    for lane in 0..LANES {
        a[lane] += b[lane] * c[lane];
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_gradients<const F: usize>(nodes: &[Node<F>], costs: &[[f64; F]; F], gradients: &mut [Gradient<F>]) {
    for (gradient, node) in gradients.iter_mut().zip(nodes) {
        for f in 0..F {
            for k in 0..3 {
                for g in 0..F {
                    gradient[f][k][g] = node.second[f][g].map(|second| MASS[k] * second);
                }
                for g in (0..F).filter(|g| costs[f][*g] != 0.0) {
                    for lane in 0..LANES {
                        gradient[f][k][g][lane] -= node.difference[k][lane] * costs[f][g];
                    }
                }
            }
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_forces<const F: usize>(nodes: &[Node<F>], gradients: &[Gradient<F>], forces: &mut [Force<F>]) {
    for (place, force) in forces.iter_mut().enumerate() {
        *force = [[[0.0; LANES]; F]; 5];
        let difference = &nodes[place + 1].difference;
        for shift in 0..3 {
            let (node, gradient) = (&nodes[place + shift], &gradients[place + shift]);
            let kappa = node.fields[0].map(|kappa| MASS[shift] * kappa);
            for f in 0..F {
                let mut factor = if f == 0 { difference[shift] } else { [0.0; LANES] };
                add_product(&mut factor, &kappa, &node.fields[f]);
                for k in 0..3 {
                    for g in 0..F {
                        add_product(&mut force[shift + k][g], &factor, &gradient[f][k][g]);
                    }
                }
            }
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn diffuse<const F: usize>(nodes: &[Node<F>], forces: &[Force<F>], diffused: &mut [Diffused<F>]) {
    for (place, velocity) in diffused.iter_mut().enumerate() {
        *velocity = [[[0.0; LANES]; F]; 7];
        for shift in 0..3 {
            let factor = nodes[place + 2].difference[shift].map(|weight| -weight);
            for k in 0..5 {
                for g in 0..F {
                    add_product(&mut velocity[shift + k][g], &factor, &forces[place + shift][k][g]);
                }
            }
        }
    }
}

/// The rows for velocities over `V` nodes; R = V + 2, and the `M` weights of `mass` are those of the power of A in V beyond the first.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_rows<const F: usize, const B: usize, const V: usize, const R: usize, const M: usize>(
    nodes: &[Node<F>],
    (gradients, velocities): (&[Gradient<F>], &[[Row<F>; V]]),
    (gamma, gamma_of_motion, carries): (f64, f64, bool),
    mass: &[f64; M],
    matrix: &mut CyclicBanded<B>,
) {
    let (own_power, next_power) = (power_of_mass::<V>(), power_of_mass::<R>());
    let margin = V / 2;
    for i in 0..nodes.len() - 2 * margin {
        // From the first node on whose velocity, gradient or mobility counts.
        let (gradients, velocities) = (&gradients[i + 1..], &velocities[i..]);
        let (own, neighbours) = (&nodes[i + margin], &nodes[i + margin - 1..]);
        for f in 0..F {
            let mut row = [[[0.0; LANES]; F]; R];
            if f == 0 {
                for k in 0..R {
                    row[k][f] = [next_power[k]; LANES];
                }
                for shift in 0..3 {
                    let (difference, kappa) = (&own.difference[shift], &neighbours[shift].fields[0]);
                    let factor = std::array::from_fn(|lane| {
                        gamma_of_motion * (difference[lane] + MASS[shift] * kappa[lane] * kappa[lane])
                    });
                    for k in 0..V {
                        for g in 0..F {
                            add_product(&mut row[shift + k][g], &factor, &velocities[shift][k][g]);
                        }
                    }
                }
            } else {
                for k in 0..V {
                    row[1 + k][f] = [own_power[k]; LANES];
                }
                if !carries {
                    let damping = std::array::from_fn(|lane| {
                        gamma_of_motion * own.fields[0][lane] * own.fields[f][lane]
                    });
                    for k in 0..V {
                        for g in 0..F {
                            add_product(&mut row[1 + k][g], &damping, &velocities[1][k][g]);
                        }
                    }
                }
                for (place, mass) in mass.iter().enumerate() {
                    let node = &nodes[i + margin + place - M / 2];
                    for shift in 0..3 {
                        let factor = node.mobility[f][shift].map(|weight| gamma * mass * weight);
                        for k in 0..3 {
                            for g in 0..F {
                                let gradient = &gradients[place + shift][f][k][g];
                                add_product(&mut row[1 + place + shift + k][g], &factor, gradient);
                            }
                        }
                    }
                }
            }
            matrix.set_rows(i * F + f, -(((R / 2) * F + f) as isize), row.as_flattened());
        }
    }
}
