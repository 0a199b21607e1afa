//! Adhesion and repulsion: ∬ G(|γ(σ) − γ(σ′)|²) dσ dσ′ with the user's G. See `THEORY.md`, eq. (E7).

use super::kernel::Kernel;
use super::{EnergyTerm, Order, ShapeFields};
use crate::expression::{Expression, ExpressionError};
use crate::geometry::CellList;

/// Self-interaction of the curve by a kernel of the squared distance q.
///
/// On the grid (|Γ|/n)² Σᵢⱼ G(|γᵢ − γⱼ|²), i = j included: the sum over all pairs within the cut-off, found by a list of
/// cells, with exact derivatives.
#[derive(Clone, Debug)]
pub struct Adhesion {
    kernel: Kernel,
    cells: CellList,
    frozen: Frozen,
    /// Scratch: squared distances from one node, G, G′ and G″ there, two components.
    squares: Vec<f64>,
    values: [Vec<f64>; 3],
    pull: [Vec<f64>; 2],
    /// Sums at the sorted nodes.
    sums: [Vec<f64>; 2],
    motion: [Vec<f64>; 2],
}

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
}

/// Distance beyond which the kernel is taken as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutOff {
    /// This distance.
    At(f64),
    /// Where G and G′ have fallen below the rounding of their largest values, if they do so near this length.
    Automatic {
        /// Length of the curve.
        length: f64,
    },
}

impl Adhesion {
    /// The interaction by `kernel`, a function of the variable 0, q, for `nodes` nodes.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative of the kernel is too large.
    pub fn new(kernel: &Expression, cut_off: CutOff, nodes: usize) -> Result<Self, ExpressionError> {
        let field = || vec![0.0; nodes];
        let pair = || [field(), field()];
        Ok(Self {
            kernel: Kernel::new(kernel, cut_off)?,
            cells: CellList::new(nodes),
            frozen: Frozen {
                cells: CellList::new(nodes),
                energy: 0.0,
                by_position: pair(),
                first: Vec::new(),
                second: Vec::new(),
            },
            squares: field(),
            values: [field(), field(), field()],
            pull: pair(),
            sums: pair(),
            motion: pair(),
        })
    }

    /// Distance beyond which the kernel is taken as zero; infinite if it does not decay.
    #[must_use]
    pub fn cut_off(&self) -> f64 {
        self.kernel.cut_off()
    }

    /// Σ_{i<j} G, with Σⱼ G′(γᵢ − γⱼ) in `sums`.
    fn sum_pairs(&mut self, order: Order) -> f64 {
        self.sums.iter_mut().for_each(|sum| sum.fill(0.0));
        let [x, y] = self.cells.position();
        let mut sum = 0.0;
        for place in 0..x.len() {
            let (mut sum_x, mut sum_y) = (0.0, 0.0);
            for others in self.cells.later_neighbours(place) {
                let count = others.len();
                let [pull_x, pull_y] = self.pull.each_mut().map(|pull| &mut pull[..count]);
                let squares = &mut self.squares[..count];
                let separations = x[others.clone()].iter().zip(&y[others.clone()]);
                for (((square, dx), dy), (x_j, y_j)) in
                    squares.iter_mut().zip(&mut *pull_x).zip(&mut *pull_y).zip(separations)
                {
                    (*dx, *dy) = (x[place] - x_j, y[place] - y_j);
                    *square = *dx * *dx + *dy * *dy;
                }
                let [value, first, second] = self.values.each_mut().map(|values| &mut values[..count]);
                self.kernel.evaluate(squares, order, [&mut *value, &mut *first, &mut *second]);
                if order >= Order::Hessian {
                    self.frozen.first.extend_from_slice(first);
                    self.frozen.second.extend_from_slice(second);
                }
                for ((first, dx), dy) in first.iter().zip(&mut *pull_x).zip(&mut *pull_y) {
                    (*dx, *dy) = (*dx * first, *dy * first);
                }
                sum += value.iter().sum::<f64>();
                sum_x += take_from(&mut self.sums[0][others.clone()], pull_x);
                sum_y += take_from(&mut self.sums[1][others], pull_y);
            }
            self.sums[0][place] += sum_x;
            self.sums[1][place] += sum_y;
        }
        sum
    }

    /// Change of Σⱼ G′(γᵢ − γⱼ) under `motion`, both at the sorted nodes.
    fn sum_motions(&mut self) {
        self.sums.iter_mut().for_each(|sum| sum.fill(0.0));
        let ([x, y], [v_x, v_y]) = (self.frozen.cells.position(), &self.motion);
        let mut pairs = 0;
        for place in 0..x.len() {
            let (mut sum_x, mut sum_y) = (0.0, 0.0);
            for others in self.frozen.cells.later_neighbours(place) {
                let [pull_x, pull_y] = self.pull.each_mut().map(|pull| &mut pull[..others.len()]);
                let (first, second) = (&self.frozen.first[pairs..], &self.frozen.second[pairs..]);
                for (k, j) in others.clone().enumerate() {
                    let (dx, dy) = (x[place] - x[j], y[place] - y[j]);
                    let (change_x, change_y) = (v_x[place] - v_x[j], v_y[place] - v_y[j]);
                    let stretch = 2.0 * second[k] * (dx * change_x + dy * change_y);
                    pull_x[k] = first[k] * change_x + stretch * dx;
                    pull_y[k] = first[k] * change_y + stretch * dy;
                }
                pairs += others.len();
                sum_x += take_from(&mut self.sums[0][others.clone()], pull_x);
                sum_y += take_from(&mut self.sums[1][others], pull_y);
            }
            self.sums[0][place] += sum_x;
            self.sums[1][place] += sum_y;
        }
    }
}

/// sums −= pull; returns the sum of `pull`.
fn take_from(sums: &mut [f64], pull: &[f64]) -> f64 {
    sums.iter_mut().zip(pull).for_each(|(sum, pull)| *sum -= pull);
    pull.iter().sum()
}

impl EnergyTerm for Adhesion {
    fn name(&self) -> &'static str {
        "adhesion"
    }

    fn has_shape_energy(&self) -> bool {
        true
    }

    fn add_shape_energy(&mut self, shape: &ShapeFields, order: Order, out: &mut ShapeFields) -> f64 {
        let (nodes, length) = (self.squares.len() as f64, shape.length);
        self.cells.sort(shape.positions(), self.kernel.cut_off());
        if order >= Order::Hessian {
            self.frozen.first.clear();
            self.frozen.second.clear();
        }
        let pairs = self.sum_pairs(order);
        let energy = (length / nodes).powi(2) * (nodes * self.kernel.at_zero() + 2.0 * pairs);
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
        if order >= Order::Hessian {
            self.frozen.energy = energy;
            std::mem::swap(&mut self.frozen.cells, &mut self.cells);
        }
        energy
    }

    fn add_shape_hessian_product(&mut self, at: &ShapeFields, motion: &ShapeFields, out: &mut ShapeFields) {
        let (nodes, length) = (self.squares.len() as f64, at.length);
        for (place, &node) in self.frozen.cells.order().iter().enumerate() {
            for axis in 0..2 {
                self.motion[axis][place] = motion.position[axis][node];
            }
        }
        self.sum_motions();
        let (factor, stretch) = (4.0 * length * length / nodes, 2.0 * motion.length / length);
        let mut work = 0.0;
        for (place, &node) in self.frozen.cells.order().iter().enumerate() {
            for axis in 0..2 {
                let frozen = self.frozen.by_position[axis][node];
                out.position[axis][node] += factor * self.sums[axis][place] + stretch * frozen;
                work += frozen * motion.position[axis][node];
            }
        }
        out.length +=
            2.0 * work / (nodes * length) + 2.0 * self.frozen.energy / (length * length) * motion.length;
    }
}
