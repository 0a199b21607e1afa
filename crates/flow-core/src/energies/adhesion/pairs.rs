//! Sums over the pairs of nodes within the cut-off.

use std::ops::Range;

use multiversion::multiversion;

use super::super::Order;
use super::Adhesion;
use crate::geometry::vectors;

/// Pairs for which the kernel is evaluated together, and those of one more node.
pub(super) const PAIRS_TOGETHER: usize = 1024;

impl Adhesion {
    /// The pairs that the sorted cells hold, if they are more than `most`.
    pub(super) fn pairs_beyond(&self, most: usize) -> Option<usize> {
        let nodes = self.shares.len();
        if nodes * nodes.saturating_sub(1) / 2 <= most {
            return None; // not even all of them
        }
        let later =
            |place| self.cells.later_neighbours(place).iter().map(ExactSizeIterator::len).sum::<usize>();
        Some((0..nodes).map(later).sum()).filter(|pairs| *pairs > most)
    }

    /// Σ_{i<j} G, with Σⱼ G′(γᵢ − γⱼ) in `sums`, and Σⱼ G in `shares` if the weights move.
    ///
    /// The kernel is evaluated for the pairs of many nodes together: those of one node are fewer than the lanes of a block.
    pub(super) fn sum_pairs(&mut self, order: Order, moving: bool) -> f64 {
        self.sums.iter_mut().chain([&mut self.shares]).for_each(|sum| sum.fill(0.0));
        let mut sum = 0.0;
        let mut start = 0;
        while start < self.shares.len() {
            let (end, count) = self.separate_pairs(start);
            let values = self.values.each_mut().map(|values| &mut values[..count]);
            self.kernel.evaluate(&self.squares[..count], order, values);
            sum = self.share_pairs(start..end, order, moving, sum);
            start = end;
        }
        sum
    }

    /// Separations of the nodes from `start` on and their later neighbours, as many as have room, with their squares; the node
    /// after the last of them, and the number of pairs.
    fn separate_pairs(&mut self, start: usize) -> (usize, usize) {
        let [x, y] = self.cells.position();
        let (mut place, mut count) = (start, 0);
        while place < x.len() && count < PAIRS_TOGETHER {
            for others in self.cells.later_neighbours(place) {
                let pairs = count..count + others.len();
                let [pull_x, pull_y] = self.pull.each_mut().map(|pull| &mut pull[pairs.clone()]);
                let squares = &mut self.squares[pairs.clone()];
                separate([x[place], y[place]], [&x[others.clone()], &y[others]], [pull_x, pull_y], squares);
                count = pairs.end;
            }
            place += 1;
        }
        (place, count)
    }

    /// Adds what the pairs of the nodes `places` give to the sums, and their values to `sum`.
    fn share_pairs(&mut self, places: Range<usize>, order: Order, moving: bool, mut sum: f64) -> f64 {
        let mut end = 0;
        for place in places {
            let (mut sum_x, mut sum_y) = (0.0, 0.0);
            for others in self.cells.later_neighbours(place) {
                let pairs = end..end + others.len();
                end = pairs.end;
                let [pull_x, pull_y] = self.pull.each_ref().map(|pull| &pull[pairs.clone()]);
                let [value, first, second] = self.values.each_mut().map(|values| &mut values[pairs.clone()]);
                if !self.weight.is_empty() {
                    let weight = &self.weight[others.clone()];
                    weigh(value, self.weight[place], weight);
                    weigh(first, self.weight[place], weight);
                    if order >= Order::Hessian {
                        weigh(second, self.weight[place], weight);
                    }
                }
                if moving {
                    self.shares[place] += vectors::sum(value);
                    vectors::add_scaled(&mut self.shares[others.clone()], 1.0, value);
                }
                sum += vectors::sum(value);
                sum_x += share(first, pull_x, &mut self.sums[0][others.clone()]);
                sum_y += share(first, pull_y, &mut self.sums[1][others]);
            }
            self.sums[0][place] += sum_x;
            self.sums[1][place] += sum_y;
        }
        if order >= Order::Hessian {
            let [value, first, second] = self.values.each_ref().map(|values| &values[..end]);
            self.frozen.first.extend_from_slice(first);
            self.frozen.second.extend_from_slice(second);
            if moving {
                self.frozen.value.extend_from_slice(value);
            }
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
                let from = [[x[place], y[place]], [v_x[place], v_y[place]]];
                change(from, [[x_j, y_j], [v_x_j, v_y_j]], [first, second], [&mut *pull_x, &mut *pull_y]);
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
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn take(sums: &mut [f64], pull: &[f64]) {
    sums.iter_mut().zip(pull).for_each(|(sum, pull)| *sum -= pull);
}

/// Separations of the point `from` from others, and their squares.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn separate([x, y]: [f64; 2], [x_j, y_j]: [&[f64]; 2], [dx, dy]: [&mut [f64]; 2], squares: &mut [f64]) {
    let count = squares.len();
    let (x_j, y_j, dx, dy) = (&x_j[..count], &y_j[..count], &mut dx[..count], &mut dy[..count]);
    for k in 0..count {
        (dx[k], dy[k]) = (x - x_j[k], y - y_j[k]);
        squares[k] = dx[k] * dx[k] + dy[k] * dy[k];
    }
}

/// Σ a b, of which each term is taken from one of the `sums`; in independent lanes, as [`vectors::sum`].
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn share(a: &[f64], b: &[f64], sums: &mut [f64]) -> f64 {
    const LANES: usize = 8;
    let mut lanes = [0.0; LANES];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let (chunks, rest) = sums.as_chunks_mut::<LANES>();
    for ((a, b), sums) in a.iter().zip(b).zip(chunks) {
        for k in 0..LANES {
            let pull = a[k] * b[k];
            lanes[k] += pull;
            sums[k] -= pull;
        }
    }
    let mut total = lanes.iter().sum::<f64>();
    for ((a, b), sum) in a_rest.iter().zip(b_rest).zip(rest) {
        total += a * b;
        *sum -= a * b;
    }
    total
}

/// Change of G′(γᵢ − γⱼ) for each j, at the points and under the motions of `from` and of the `others`.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn change(
    [[x, y], [v_x, v_y]]: [[f64; 2]; 2],
    [[x_j, y_j], [v_x_j, v_y_j]]: [[&[f64]; 2]; 2],
    [first, second]: [&[f64]; 2],
    [pull_x, pull_y]: [&mut [f64]; 2],
) {
    let count = pull_x.len();
    let (x_j, y_j, v_x_j, v_y_j) = (&x_j[..count], &y_j[..count], &v_x_j[..count], &v_y_j[..count]);
    let (first, second, pull_y) = (&first[..count], &second[..count], &mut pull_y[..count]);
    for k in 0..count {
        let (dx, dy) = (x - x_j[k], y - y_j[k]);
        let (change_x, change_y) = (v_x - v_x_j[k], v_y - v_y_j[k]);
        let stretch = 2.0 * second[k] * (dx * change_x + dy * change_y);
        pull_x[k] = first[k] * change_x + stretch * dx;
        pull_y[k] = first[k] * change_y + stretch * dy;
    }
}
