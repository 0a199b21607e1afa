//! Adhesion and repulsion: ∬ G(|γ(σ) − γ(σ′)|²) dσ dσ′ with the user's G. See `THEORY.md`, eq. (E7).

mod pairs;

use super::kernel::{CutOff, Kernel};
use super::{EnergyTerm, Fields, Order, ShapeFields, TermFault};
use crate::expression::{Expression, ExpressionError};
use crate::geometry::CellList;
use crate::geometry::vectors::dot;

/// Self-interaction of the curve by a kernel of the squared distance q.
///
/// On the grid (|Γ|/n)² Σᵢⱼ wᵢwⱼG(|γᵢ − γⱼ|²), i = j included: the sum over all pairs within the cut-off, found by a list of
/// cells, with exact derivatives.
#[derive(Clone, Debug)]
pub struct Adhesion {
    kernel: Kernel,
    cells: CellList,
    frozen: Frozen,
    /// Scratch: squared distances of some pairs, G, G′ and G″ there, two components.
    squares: Vec<f64>,
    values: [Vec<f64>; 3],
    pull: [Vec<f64>; 2],
    /// Sums at the sorted nodes.
    sums: [Vec<f64>; 2],
    motion: [Vec<f64>; 2],
    /// Weights of the sorted nodes; empty if all are 1.
    weight: Vec<f64>,
    /// Σⱼ wᵢwⱼG, j ≠ i, and its motion, at the sorted nodes, where the weights move; δw/w there.
    shares: Vec<f64>,
    weight_motion: Vec<f64>,
    /// Pairs that are allowed, and those met last if they are more.
    most_pairs: usize,
    too_many: Option<usize>,
}

/// Most pairs whose derivatives are kept, 16 bytes for each, 24 where weights move: 2.1 or 3.2 GB. All of 16384 nodes are fewer.
const MOST_PAIRS: usize = 1 << 27;

/// What the second derivative needs.
#[derive(Clone, Debug)]
struct Frozen {
    cells: CellList,
    energy: f64,
    /// Derivative by the positions.
    by_position: [Vec<f64>; 2],
    /// G′ and G″ of all pairs, in the order in which they are met.
    first: Vec<f64>,
    second: Vec<f64>,
    /// G of all pairs, weights of the sorted nodes and the derivative by them, where the weights move.
    value: Vec<f64>,
    weight: Vec<f64>,
    by_weight: Vec<f64>,
}

impl Adhesion {
    /// The interaction by `kernel`, a function of the variable 0, q, for `nodes` nodes.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative of the kernel is too large.
    /// # Panics
    /// If the kernel depends on a second variable.
    pub fn new(kernel: &Expression, cut_off: CutOff, nodes: usize) -> Result<Self, ExpressionError> {
        assert!(kernel.arity() <= 1, "`{}` is no function of q alone", kernel.text());
        let field = || vec![0.0; nodes];
        let pair = || [field(), field()];
        let of_pairs = || vec![0.0; (pairs::PAIRS_TOGETHER + nodes).min(nodes * nodes)];
        Ok(Self {
            kernel: Kernel::new(kernel, cut_off)?,
            cells: CellList::new(nodes),
            frozen: Frozen {
                cells: CellList::new(nodes),
                energy: 0.0,
                by_position: pair(),
                first: Vec::new(),
                second: Vec::new(),
                value: Vec::new(),
                weight: Vec::with_capacity(nodes),
                by_weight: Vec::with_capacity(nodes),
            },
            squares: of_pairs(),
            values: [of_pairs(), of_pairs(), of_pairs()],
            pull: [of_pairs(), of_pairs()],
            sums: pair(),
            motion: pair(),
            weight: Vec::with_capacity(nodes),
            shares: field(),
            weight_motion: field(),
            most_pairs: MOST_PAIRS,
            too_many: None,
        })
    }

    /// Distance beyond which the kernel is taken as zero; infinite if it does not decay.
    #[must_use]
    pub fn cut_off(&self) -> f64 {
        self.kernel.cut_off()
    }
}

impl EnergyTerm for Adhesion {
    fn name(&self) -> &'static str {
        "adhesion"
    }

    fn has_shape_energy(&self) -> bool {
        true
    }

    fn is_line_energy(&self) -> bool {
        true
    }

    fn largest_spacing(&self, length: f64, error: f64) -> f64 {
        self.kernel.largest_spacing(length, error)
    }

    fn kept_bytes(&self) -> f64 {
        let Frozen { first, second, value, .. } = &self.frozen;
        (size_of::<f64>() * (first.len() + second.len() + value.len())) as f64
    }

    fn fault(&self, _: Fields<'_>) -> Option<TermFault> {
        let (nodes, most) = (self.shares.len(), self.most_pairs);
        self.too_many.map(|pairs| TermFault::TooManyPairs { nodes, pairs, most })
    }

    fn add_shape_energy(&mut self, shape: &ShapeFields, order: Order, out: &mut ShapeFields) -> f64 {
        let (nodes, length) = (self.shares.len() as f64, shape.length);
        self.cells.sort(shape.positions(), self.kernel.cut_off());
        self.too_many = self.pairs_beyond(self.most_pairs);
        if self.too_many.is_some() {
            if order >= Order::Hessian {
                self.frozen.energy = f64::NAN; // there is no derivative
            }
            return f64::NAN;
        }
        if order >= Order::Hessian {
            self.frozen.first.clear();
            self.frozen.second.clear();
            self.frozen.value.clear();
        }
        let moving = !out.weight.is_empty();
        self.weight.clear();
        if !shape.weight.is_empty() {
            self.weight.extend(self.cells.order().iter().map(|node| shape.weight[*node]));
        }
        let pairs = self.sum_pairs(order, moving);
        let squares = if self.weight.is_empty() { nodes } else { dot(&self.weight, &self.weight) };
        let energy = (length / nodes).powi(2) * (squares * self.kernel.at_zero() + 2.0 * pairs);
        let factor = 4.0 * length * length / nodes;
        for (place, &node) in self.cells.order().iter().enumerate() {
            for axis in 0..2 {
                out.position[axis][node] += factor * self.sums[axis][place];
                if order >= Order::Hessian {
                    self.frozen.by_position[axis][node] = factor * self.sums[axis][place];
                }
            }
        }
        out.length += 2.0 * energy / length;
        if moving {
            let factor = 2.0 * length * length / nodes;
            let at_zero = self.kernel.at_zero();
            for ((share, weight), &node) in self.shares.iter_mut().zip(&self.weight).zip(self.cells.order()) {
                *share = factor * (weight * at_zero + *share / weight);
                out.weight[node] += *share;
            }
            if order >= Order::Hessian {
                self.frozen.weight.clone_from(&self.weight);
                self.frozen.by_weight.clone_from(&self.shares);
            }
        }
        if order >= Order::Hessian {
            self.frozen.energy = energy;
            std::mem::swap(&mut self.frozen.cells, &mut self.cells);
        }
        energy
    }

    fn add_shape_hessian_product(&mut self, at: &ShapeFields, motion: &ShapeFields, out: &mut ShapeFields) {
        let (nodes, length) = (self.shares.len() as f64, at.length);
        if self.frozen.energy.is_nan() {
            out.length = f64::NAN;
            return;
        }
        for (place, &node) in self.frozen.cells.order().iter().enumerate() {
            for axis in 0..2 {
                self.motion[axis][place] = motion.position[axis][node];
            }
        }
        let moving = !motion.weight.is_empty();
        if moving {
            let weights = self.frozen.cells.order().iter().zip(&self.frozen.weight);
            for (rate, (&node, weight)) in self.weight_motion.iter_mut().zip(weights) {
                *rate = motion.weight[node] / weight;
            }
        }
        self.sum_motions(moving);
        let (factor, stretch) = (4.0 * length * length / nodes, 2.0 * motion.length / length);
        let mut work = 0.0;
        for (place, &node) in self.frozen.cells.order().iter().enumerate() {
            for axis in 0..2 {
                let frozen = self.frozen.by_position[axis][node];
                out.position[axis][node] += factor * self.sums[axis][place] + stretch * frozen;
                work += frozen * motion.position[axis][node];
            }
        }
        if moving {
            let (factor, at_zero) = (2.0 * length * length / nodes, self.kernel.at_zero());
            for (place, &node) in self.frozen.cells.order().iter().enumerate() {
                let (weight, rate) = (self.frozen.weight[place], self.weight_motion[place]);
                let by_weight = self.frozen.by_weight[place];
                // ω = c(wG₀ + s/w): δω = c(δwG₀ + δs/w − sδw/w²) + ω·2δL/L.
                let share = by_weight / factor - weight * at_zero;
                out.weight[node] += factor
                    * (weight * rate * at_zero + self.shares[place] / weight - share * rate)
                    + stretch * by_weight;
                work += by_weight * weight * rate;
            }
        }
        out.length +=
            2.0 * work / (nodes * length) + 2.0 * self.frozen.energy / (length * length) * motion.length;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wavy curve with some stretches near each other.
    fn shape(nodes: usize) -> ShapeFields {
        let mut shape = ShapeFields { length: 9.0, ..ShapeFields::new(nodes) };
        for i in 0..nodes {
            let s = std::f64::consts::TAU * i as f64 / nodes as f64;
            shape.position[0][i] = 1.5 * s.cos() + 0.3 * (4.0 * s).sin();
            shape.position[1][i] = 0.4 * s.sin() + 0.2 * (3.0 * s).cos();
        }
        shape
    }

    #[test]
    fn more_pairs_than_allowed_are_a_fault_and_nothing_is_kept_of_them() {
        let kernel = Expression::parse("exp(-q)", &["q"]).unwrap();
        let (nodes, shape) = (64, shape(64));
        let mut out = ShapeFields::new(nodes);
        for (cut_off, most) in [(50.0, 64 * 63 / 2), (0.2, 1000)] {
            let mut term =
                Adhesion { most_pairs: most, ..Adhesion::new(&kernel, CutOff::At(cut_off), nodes).unwrap() };
            assert!(term.add_shape_energy(&shape, Order::Hessian, &mut out).is_finite());
            let pairs = term.frozen.first.len();
            assert_eq!(term.kept_bytes(), 16.0 * pairs as f64);
            assert!(pairs <= most && term.too_many.is_none(), "{pairs}");

            let mut term = Adhesion {
                most_pairs: pairs - 1,
                ..Adhesion::new(&kernel, CutOff::At(cut_off), nodes).unwrap()
            };
            assert!(term.add_shape_energy(&shape, Order::Hessian, &mut out).is_nan());
            assert_eq!((term.too_many, term.kept_bytes()), (Some(pairs), 0.0));
            term.add_shape_hessian_product(&shape, &ShapeFields::new(nodes), &mut out);
            assert!(out.length.is_nan(), "no derivative");
        }
    }

    /// The kernel jumps at every cut-off here: a pair too much or too few would show.
    #[test]
    fn the_sum_is_that_over_all_pairs_within_the_cut_off() {
        let kernel = Expression::parse("exp(-q) + 0.1*q", &["q"]).unwrap();
        for (nodes, cut_off) in [(64, 0.05), (101, 0.3), (400, 0.2), (400, 1.1), (33, 50.0)] {
            let shape = shape(nodes);
            let mut term = Adhesion::new(&kernel, CutOff::At(cut_off), nodes).unwrap();
            let mut out = ShapeFields::new(nodes);
            let energy = term.add_shape_energy(&shape, Order::Gradient, &mut out);
            let [x, y] = shape.positions();
            let (mut sum, mut pull) = (0.0, [vec![0.0; nodes], vec![0.0; nodes]]);
            for i in 0..nodes {
                for j in 0..nodes {
                    let (dx, dy) = (x[i] - x[j], y[i] - y[j]);
                    let q: f64 = dx * dx + dy * dy;
                    if q <= cut_off * cut_off {
                        let slope = 0.1 - (-q).exp();
                        sum += (-q).exp() + 0.1 * q;
                        pull[0][i] += 4.0 * slope * dx;
                        pull[1][i] += 4.0 * slope * dy;
                    }
                }
            }
            let weight = shape.length * shape.length / nodes as f64;
            assert!((energy - weight / nodes as f64 * sum).abs() < 1e-12 * energy, "{nodes}, {cut_off}");
            for axis in 0..2 {
                for i in 0..nodes {
                    let expected = weight * pull[axis][i];
                    assert!((out.position[axis][i] - expected).abs() < 1e-10, "{nodes}, {cut_off}, node {i}");
                }
            }
        }
    }
}
