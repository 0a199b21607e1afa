//! Sums over the pairs of nodes within the cut-off.

use super::super::Order;
use super::Adhesion;
use crate::geometry::vectors::{self, dot};

impl Adhesion {
    /// Σ_{i<j} G, with Σⱼ G′(γᵢ − γⱼ) in `sums`, and Σⱼ G in `shares` if the weights move.
    pub(super) fn sum_pairs(&mut self, order: Order, moving: bool) -> f64 {
        self.sums.iter_mut().chain([&mut self.shares]).for_each(|sum| sum.fill(0.0));
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
                if !self.weight.is_empty() {
                    let weight = &self.weight[others.clone()];
                    weigh(value, self.weight[place], weight);
                    weigh(first, self.weight[place], weight);
                    if order >= Order::Hessian {
                        weigh(second, self.weight[place], weight);
                    }
                }
                if order >= Order::Hessian {
                    self.frozen.first.extend_from_slice(first);
                    self.frozen.second.extend_from_slice(second);
                }
                if moving {
                    self.shares[place] += vectors::sum(value);
                    vectors::add_scaled(&mut self.shares[others.clone()], 1.0, value);
                    if order >= Order::Hessian {
                        self.frozen.value.extend_from_slice(value);
                    }
                }
                sum += vectors::sum(value);
                sum_x += dot(first, pull_x);
                sum_y += dot(first, pull_y);
                take_products(&mut self.sums[0][others.clone()], first, pull_x);
                take_products(&mut self.sums[1][others], first, pull_y);
            }
            self.sums[0][place] += sum_x;
            self.sums[1][place] += sum_y;
        }
        sum
    }

    /// Change of Σⱼ G′(γᵢ − γⱼ) under `motion`, both at the sorted nodes, and of Σⱼ G if the weights move.
    pub(super) fn sum_motions(&mut self, moving: bool) {
        self.sums.iter_mut().chain([&mut self.shares]).for_each(|sum| sum.fill(0.0));
        let ([x, y], [v_x, v_y]) = (self.frozen.cells.position(), &self.motion);
        let mut pairs = 0;
        for place in 0..x.len() {
            let (mut sum_x, mut sum_y) = (0.0, 0.0);
            for others in self.frozen.cells.later_neighbours(place) {
                let count = others.len();
                let [pull_x, pull_y] = self.pull.each_mut().map(|pull| &mut pull[..count]);
                let first = &self.frozen.first[pairs..pairs + count];
                let second = &self.frozen.second[pairs..pairs + count];
                let [x_j, y_j] = [&x[others.clone()], &y[others.clone()]];
                let [v_x_j, v_y_j] = [&v_x[others.clone()], &v_y[others.clone()]];
                for k in 0..count {
                    let (dx, dy) = (x[place] - x_j[k], y[place] - y_j[k]);
                    let (change_x, change_y) = (v_x[place] - v_x_j[k], v_y[place] - v_y_j[k]);
                    let stretch = 2.0 * second[k] * (dx * change_x + dy * change_y);
                    pull_x[k] = first[k] * change_x + stretch * dx;
                    pull_y[k] = first[k] * change_y + stretch * dy;
                }
                if moving {
                    let rates = &self.weight_motion;
                    for k in 0..count {
                        let (dx, dy) = (x[place] - x_j[k], y[place] - y_j[k]);
                        let (change_x, change_y) = (v_x[place] - v_x_j[k], v_y[place] - v_y_j[k]);
                        let grown = rates[place] + rates[others.start + k];
                        pull_x[k] += grown * first[k] * dx;
                        pull_y[k] += grown * first[k] * dy;
                        let change = grown * self.frozen.value[pairs + k]
                            + 2.0 * first[k] * (dx * change_x + dy * change_y);
                        self.shares[place] += change;
                        self.shares[others.start + k] += change;
                    }
                }
                pairs += count;
                sum_x += vectors::sum(pull_x);
                sum_y += vectors::sum(pull_y);
                take(&mut self.sums[0][others.clone()], pull_x);
                take(&mut self.sums[1][others], pull_y);
            }
            self.sums[0][place] += sum_x;
            self.sums[1][place] += sum_y;
        }
    }
}

/// values ×= factor × weight.
fn weigh(values: &mut [f64], factor: f64, weight: &[f64]) {
    values.iter_mut().zip(weight).for_each(|(value, weight)| *value *= factor * weight);
}

/// sums −= pull.
fn take(sums: &mut [f64], pull: &[f64]) {
    sums.iter_mut().zip(pull).for_each(|(sum, pull)| *sum -= pull);
}

/// sums −= a b.
fn take_products(sums: &mut [f64], a: &[f64], b: &[f64]) {
    sums.iter_mut().zip(a).zip(b).for_each(|((sum, a), b)| *sum -= a * b);
}
