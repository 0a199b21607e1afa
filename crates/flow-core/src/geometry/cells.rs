//! Points of the plane sorted into square cells, so that those near each other are found without looking at all pairs.

use std::ops::Range;

/// Points sorted by the rows of a grid of cells; holds all its room.
#[derive(Clone, Debug)]
pub struct CellList {
    /// Cells along each axis, at least 1.
    cells: [usize; 2],
    most_cells: usize,
    /// First sorted point of each cell, row by row, and the number of points at the end.
    starts: Vec<usize>,
    /// Which point stands at each sorted place.
    order: Vec<usize>,
    /// Cell of each sorted point.
    cell: Vec<usize>,
    position: [Vec<f64>; 2],
}

impl CellList {
    /// Room for `points` points, all of them in one cell until they are sorted.
    #[must_use]
    pub fn new(points: usize) -> Self {
        let most_cells = (points as f64).sqrt().ceil().max(1.0) as usize;
        let mut starts = Vec::with_capacity(most_cells * most_cells + 1);
        starts.extend([0, points]);
        Self {
            cells: [1, 1],
            most_cells,
            starts,
            order: (0..points).collect(),
            cell: vec![0; points],
            position: [vec![0.0; points], vec![0.0; points]],
        }
    }

    /// Sorts the points `position`, given by component, into cells not smaller than `radius`.
    ///
    /// # Panics
    /// If they are not as many as there is room for.
    pub fn sort(&mut self, position: [&[f64]; 2], radius: f64) {
        let points = position[0].len();
        assert!(
            points == self.order.len() && position[1].len() == points,
            "as many points as there is room for"
        );
        // Rounding must not put points within the radius two cells apart.
        let least = radius * (1.0 + 1e-12);
        let mut low = [0.0; 2];
        let mut per_length = [0.0; 2];
        for axis in 0..2 {
            let (lowest, highest) = extent(position[axis]);
            let width = highest - lowest;
            // A width or a radius that is NaN, zero or infinite makes one cell.
            let cells = ((width / least) as usize).clamp(1, self.most_cells);
            (self.cells[axis], low[axis], per_length[axis]) = (cells, lowest, cells as f64 / width);
        }
        let [columns, rows] = self.cells;
        let cell_of = |i: usize| {
            let place = |axis: usize, cells: usize| {
                (((position[axis][i] - low[axis]) * per_length[axis]) as usize).min(cells - 1)
            };
            place(1, rows) * columns + place(0, columns)
        };
        self.starts.clear();
        self.starts.resize(columns * rows + 1, 0);
        for i in 0..points {
            self.starts[cell_of(i) + 1] += 1;
        }
        for cell in 0..columns * rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        // Each start serves as the next free place of its cell and is then the start of the next cell.
        for i in 0..points {
            let cell = cell_of(i);
            let place = self.starts[cell];
            self.starts[cell] += 1;
            (self.order[place], self.cell[place]) = (i, cell);
            (self.position[0][place], self.position[1][place]) = (position[0][i], position[1][i]);
        }
        self.starts.rotate_right(1);
        self.starts[0] = 0;
    }

    /// Which point stands at each sorted place.
    #[must_use]
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// Sorted positions by component.
    #[must_use]
    pub fn position(&self) -> [&[f64]; 2] {
        [&self.position[0], &self.position[1]]
    }

    /// Sorted places after `place` that hold all points within the radius of it that come later: each pair of
    /// near points is met once. The places hold farther points too.
    #[must_use]
    pub fn later_neighbours(&self, place: usize) -> [Range<usize>; 2] {
        let [columns, rows] = self.cells;
        let (row, column) = (self.cell[place] / columns, self.cell[place] % columns);
        let last = (column + 1).min(columns - 1);
        let same_row = place + 1..self.starts[row * columns + last + 1];
        if row + 1 == rows {
            return [same_row, 0..0];
        }
        let next = (row + 1) * columns;
        [same_row, self.starts[next + column.saturating_sub(1)]..self.starts[next + last + 1]]
    }
}

fn extent(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows of points along a wave, and some in between.
    fn points(n: usize) -> [Vec<f64>; 2] {
        let x = (0..n).map(|i| (0.37 * i as f64).sin() * 3.0 + 0.01 * i as f64).collect();
        let y = (0..n).map(|i| (1.7 * i as f64).cos() * 2.0).collect();
        [x, y]
    }

    #[test]
    fn every_near_pair_is_met_once() {
        for (n, radius) in [(1, 1.0), (2, 10.0), (200, 0.3), (200, 1.0), (333, 0.01), (64, f64::INFINITY)] {
            let [x, y] = points(n);
            let mut cells = CellList::new(n);
            cells.sort([&x, &y], radius);
            let mut met = vec![0; n * n];
            for place in 0..n {
                for other in cells.later_neighbours(place).into_iter().flatten() {
                    let (i, j) = (cells.order()[place], cells.order()[other]);
                    met[i.min(j) * n + i.max(j)] += 1;
                }
            }
            for i in 0..n {
                assert_eq!(met[i * n + i], 0);
                for j in i + 1..n {
                    let near = (x[i] - x[j]).hypot(y[i] - y[j]) <= radius;
                    assert!(met[i * n + j] <= 1 && (met[i * n + j] == 1 || !near), "{i}, {j}");
                }
            }
        }
    }

    #[test]
    fn points_that_are_no_numbers_or_all_the_same_make_one_cell() {
        let mut cells = CellList::new(4);
        for x in [[f64::NAN; 4], [2.0; 4], [0.0, f64::INFINITY, 1.0, 2.0]] {
            cells.sort([&x, &x], 0.1);
            assert_eq!(cells.later_neighbours(0)[0].end, 4);
        }
    }
}
