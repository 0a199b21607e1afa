//! Right-preconditioned GMRES for (I − γJ)x = r in the error norm. See `THEORY.md`, eq. (I3).

use super::error_norm::ErrorNorm;
use super::{Counters, Problem};
use crate::geometry::vectors::{add_scaled, scale, scale_into};

/// A new vector of this part of its product before orthogonalisation is rounding, of fifty entries or so: the basis spans the solution.
const EXHAUSTED: f64 = 1e-14;

/// Right-preconditioned GMRES for (I − γJ)x = r, in the inner product of the [`ErrorNorm`]: room for Krylov bases up to a fixed size;
/// nothing is allocated in a solve. See `THEORY.md`, eq. (I3).
///
/// Most solves take a few vectors, and nodes that follow the solution want new room every few steps: what is not used is not
/// written.
#[derive(Debug)]
pub struct Gmres {
    size: usize,
    basis: Vec<f64>,
    hessenberg: Vec<Vec<f64>>,
    rotations: Vec<[f64; 2]>,
    right: Vec<f64>,
    product: Vec<f64>,
    /// The basis, preconditioned.
    preconditioned: Vec<f64>,
}

/// How far a residual is to be reduced.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The norm that measures it, and the inner product of the basis.
    pub norm: &'a ErrorNorm,
    /// Norm below which it shall fall.
    pub goal: f64,
    /// Part of itself below which it shall fall.
    pub reduction: f64,
    /// Part of itself below which it is to fall if there is room for the vectors that this takes.
    pub wanted: f64,
    /// Whether its norm is taken with the weights of the problem.
    pub weighted: bool,
}

/// What a solve reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Iterations until the residual was below its goal: what they tell of the preconditioner is not what more of them are for.
    pub iterations: usize,
    /// Norm of the residual; no number if a product was not finite.
    pub residual: f64,
    /// Whether the residual is below its goal.
    pub converged: bool,
}

impl Clone for Gmres {
    /// As much room, with nothing in it.
    fn clone(&self) -> Self {
        Self::new(self.size, self.hessenberg.len())
    }
}

impl Gmres {
    /// At most `most` iterations on vectors of `size` entries.
    #[must_use]
    pub fn new(size: usize, most: usize) -> Self {
        Self {
            size,
            basis: Vec::with_capacity(size * (most + 1)),
            hessenberg: vec![vec![0.0; most + 1]; most],
            rotations: vec![[1.0, 0.0]; most],
            right: vec![0.0; most + 1],
            product: vec![0.0; size],
            preconditioned: Vec::with_capacity(size * most),
        }
    }

    /// Solves until the residual meets the target; overwrites `r` by x.
    pub fn solve(
        &mut self,
        problem: &mut dyn Problem,
        gamma: f64,
        Target { norm, goal, reduction, wanted, weighted }: Target<'_>,
        r: &mut [f64],
        counters: &mut Counters,
    ) -> Solved {
        if weighted {
            problem.weigh(r);
        }
        let start = norm.norm(r);
        let finite = start.is_finite();
        if !finite || start == 0.0 {
            return Solved { iterations: 0, residual: start, converged: finite };
        }
        let goal = goal.min(reduction * start);
        let wanted = goal.min(wanted * start);
        self.right.fill(0.0);
        self.right[0] = start;
        self.hold(1);
        scale_into(&mut self.basis[..self.size], 1.0 / start, r);
        let (mut iterations, mut to_goal) = (0, 0);
        let mut residual = start;
        while iterations < self.hessenberg.len() && residual > wanted {
            let k = iterations;
            self.hold(k + 2);
            let (known, next) = self.basis.split_at_mut((k + 1) * self.size);
            let next = &mut next[..self.size];
            let preconditioned = &mut self.preconditioned[k * self.size..(k + 1) * self.size];
            preconditioned.copy_from_slice(&known[k * self.size..]);
            if weighted {
                problem.unweigh(preconditioned);
            }
            problem.precondition(preconditioned);
            counters.solves += 1;
            problem.jacobian_product(preconditioned, &mut self.product);
            counters.jacobian_products += 1;
            next.copy_from_slice(preconditioned);
            add_scaled(next, -gamma, &self.product);
            if weighted {
                problem.weigh(next);
            }
            let column = &mut self.hessenberg[k];
            for (entry, v) in column.iter_mut().zip(known.chunks_exact(self.size)) {
                *entry = norm.product(next, v);
                add_scaled(next, -*entry, v);
            }
            let size = norm.norm(next);
            for (j, [c, s]) in self.rotations[..k].iter().enumerate() {
                (column[j], column[j + 1]) =
                    (c * column[j] + s * column[j + 1], c * column[j + 1] - s * column[j]);
            }
            let radius = column[k].hypot(size);
            if !radius.is_finite() || radius == 0.0 {
                if residual <= goal {
                    break; // what was asked for is there; more was but wanted
                }
                let residual = if radius == 0.0 { residual } else { f64::NAN };
                return Solved { iterations, residual, converged: false };
            }
            let (c, s) = (column[k] / radius, size / radius);
            self.rotations[k] = [c, s];
            column[k] = radius;
            self.right[k + 1] = -s * self.right[k];
            self.right[k] *= c;
            if residual > goal {
                to_goal += 1;
            }
            residual = self.right[k + 1].abs();
            iterations += 1;
            if size <= EXHAUSTED * radius {
                break;
            }
            scale(next, 1.0 / size);
        }
        counters.krylov_iterations += iterations as u64;
        self.combine(iterations, r);
        Solved { iterations: to_goal, residual, converged: residual <= goal }
    }

    /// Makes the first `vectors` of the basis, and all but the last of them preconditioned, within the room there is.
    fn hold(&mut self, vectors: usize) {
        let (all, preconditioned) = (self.size * vectors, self.size * (vectors - 1));
        if self.basis.len() < all {
            self.basis.resize(all, 0.0);
            self.preconditioned.resize(preconditioned, 0.0);
        }
    }

    /// Back substitution, and the combination of the basis into `x`.
    fn combine(&mut self, iterations: usize, x: &mut [f64]) {
        for row in (0..iterations).rev() {
            for column in row + 1..iterations {
                self.right[row] -= self.hessenberg[column][row] * self.right[column];
            }
            self.right[row] /= self.hessenberg[row][row];
        }
        x.fill(0.0);
        for (z, factor) in self.preconditioned.chunks_exact(self.size).zip(&self.right[..iterations]) {
            add_scaled(x, *factor, z);
        }
    }
}
