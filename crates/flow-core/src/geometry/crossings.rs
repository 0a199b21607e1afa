//! Where a closed curve crosses itself.

/// A crossing of two segments of the polygon of the nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The segment that comes first, from node `first` to the next.
    pub first: usize,
    /// The other segment.
    pub second: usize,
    /// Where they cross.
    pub position: [f64; 2],
}

/// Finds the self-crossings of closed polygons, in nearly linear time for nodes at equal distances.
///
/// Coordinates are rounded to 2⁻²⁹ of the extent of the curve, 2e-9, and compared exactly there; a node on a
/// segment counts as left of it, so that a crossing at a node is found once. Stretches on top of each other do
/// not count.
#[derive(Clone, Debug)]
pub struct Crossings {
    /// Rounded nodes.
    nodes: [Vec<i64>; 2],
    /// Each segment under each cell that it may meet, sorted by cell.
    entries: Vec<(u64, u32)>,
    found: Vec<Crossing>,
}

/// Steps of the rounded coordinates along the longer side; products of differences stay within 64 bits.
const STEPS: f64 = (1_u64 << 29) as f64;

impl Crossings {
    /// Room for polygons of `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self {
            nodes: [vec![0; nodes], vec![0; nodes]],
            entries: Vec::with_capacity(4 * nodes),
            found: Vec::new(),
        }
    }

    /// The crossings of the closed polygon through `position`, by component, in the order of their first segments.
    pub fn find(&mut self, position: [&[f64]; 2]) -> &[Crossing] {
        self.found.clear();
        if !self.round(position) || self.is_star_shaped() {
            return &self.found;
        }
        let width = self.enter_cells();
        let mut start = 0;
        while start < self.entries.len() {
            let cell = self.entries[start].0;
            let in_cell = self.entries[start..].partition_point(|(other, _)| *other == cell);
            for a in start..start + in_cell {
                for b in a + 1..start + in_cell {
                    self.compare(
                        cell,
                        width,
                        [self.entries[a].1 as usize, self.entries[b].1 as usize],
                        position,
                    );
                }
            }
            start += in_cell;
        }
        self.found.sort_unstable_by_key(|crossing| (crossing.first, crossing.second));
        &self.found
    }

    /// The number of crossings of the closed polygon through `position`.
    pub fn count(&mut self, position: [&[f64]; 2]) -> usize {
        self.find(position).len()
    }

    /// Rounds the nodes; false if they are no finite points of some extent.
    fn round(&mut self, position: [&[f64]; 2]) -> bool {
        let lowest = position.map(|x| x.iter().copied().fold(f64::INFINITY, f64::min));
        let highest = position.map(|x| x.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        let extent = (highest[0] - lowest[0]).max(highest[1] - lowest[1]);
        let finite = position.iter().all(|x| x.iter().all(|x| x.is_finite()));
        if !(finite && extent.is_finite() && extent > 0.0) {
            return false;
        }
        for (axis, rounded) in self.nodes.iter_mut().enumerate() {
            assert_eq!(rounded.len(), position[axis].len(), "as many nodes as there is room for");
            for (rounded, x) in rounded.iter_mut().zip(position[axis]) {
                *rounded = ((x - lowest[axis]) / extent * STEPS).round() as i64;
            }
        }
        true
    }

    /// Whether the ray from the mean of the nodes sweeps the polygon once, without turning back: it then meets each segment
    /// in a sector of its own, and no two cross. Exact, and far cheaper than the search.
    fn is_star_shaped(&self) -> bool {
        let count = self.nodes[0].len() as i64;
        let centre = [self.nodes[0].iter().sum::<i64>() / count, self.nodes[1].iter().sum::<i64>() / count];
        let mut turns = [0_usize; 2];
        let mut swept = [0_usize; 2];
        for segment in 0..self.nodes[0].len() {
            let (a, b) = (self.node(segment), self.node(self.next(segment)));
            let side = cross(centre, a, b);
            if side == 0 {
                return false;
            }
            let way = usize::from(side < 0);
            swept[way] += 1;
            turns[way] += usize::from((a[1] < centre[1]) != (b[1] < centre[1]));
        }
        // A turn passes the height of the centre upwards and downwards.
        swept.contains(&0) && turns.contains(&2)
    }

    /// Lowest and highest corner of the box around a segment.
    fn corners(&self, segment: usize) -> [[i64; 2]; 2] {
        let (a, b) = (self.node(segment), self.node(self.next(segment)));
        [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]]
    }

    fn node(&self, i: usize) -> [i64; 2] {
        [self.nodes[0][i], self.nodes[1][i]]
    }

    fn next(&self, i: usize) -> usize {
        (i + 1) % self.nodes[0].len()
    }

    /// Lists each segment under the cells that its box meets; returns the width of the cells, that of the longest
    /// box.
    fn enter_cells(&mut self) -> i64 {
        self.entries.clear();
        let segments = self.nodes[0].len();
        let box_width = |[low, high]: [[i64; 2]; 2]| (high[0] - low[0]).max(high[1] - low[1]);
        let width = (0..segments).map(|segment| box_width(self.corners(segment))).max().unwrap_or(0).max(1);
        for segment in 0..segments {
            let [low, high] = self.corners(segment);
            for row in low[1] / width..=high[1] / width {
                for column in low[0] / width..=high[0] / width {
                    self.entries.push((cell(row, column), segment as u32));
                }
            }
        }
        self.entries.sort_unstable();
        width
    }

    /// Notes the crossing of two segments, if they cross and meet in this cell first.
    fn compare(&mut self, here: u64, width: i64, [first, second]: [usize; 2], position: [&[f64]; 2]) {
        if self.next(first) == second || self.next(second) == first {
            return;
        }
        let ([low_a, high_a], [low_b, high_b]) = (self.corners(first), self.corners(second));
        let low = [low_a[0].max(low_b[0]), low_a[1].max(low_b[1])];
        let apart = (0..2).any(|axis| low[axis] > high_a[axis].min(high_b[axis]));
        // Segments that share several cells are compared in that of the lowest corner that their boxes share.
        if apart || cell(low[1] / width, low[0] / width) != here {
            return;
        }
        let [a, b] = [self.node(first), self.node(self.next(first))];
        let [c, d] = [self.node(second), self.node(self.next(second))];
        if is_left(a, b, c) == is_left(a, b, d) || is_left(c, d, a) == is_left(c, d, b) {
            return;
        }
        let at = |i: usize| [position[0][i], position[1][i]];
        // c and d are on different sides of the line through a and b.
        let [side_c, side_d] = [cross(a, b, c) as f64, cross(a, b, d) as f64];
        let part = side_c / (side_c - side_d);
        let (from, to) = (at(second), at(self.next(second)));
        let point = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
        self.found.push(Crossing { first, second, position: point });
    }
}

fn cell(row: i64, column: i64) -> u64 {
    ((row as u64) << 32) | column as u64
}

/// (b − a) × (c − a).
fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_left(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> bool {
    cross(a, b, c) >= 0
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::expression::Expression;
    use crate::geometry::shapes::Shape;

    fn crossings(shape: &Shape, nodes: usize) -> Vec<Crossing> {
        let curve = shape.resample(nodes).unwrap();
        let component = |axis: usize| curve.position.iter().map(|p| p[axis]).collect::<Vec<_>>();
        Crossings::new(nodes).find([&component(0), &component(1)]).to_vec()
    }

    fn parametric(x: &str, y: &str) -> Shape {
        let parse = |text| Expression::parse(text, &["phi"]).unwrap();
        Shape::Parametric { x: parse(x), y: parse(y) }
    }

    #[test]
    fn a_figure_eight_crosses_itself_once() {
        // On even numbers of nodes two of them stand on the crossing.
        for nodes in [16, 33, 64, 255, 256, 1024] {
            let found = crossings(&Shape::FigureEight { size: 1.3 }, nodes);
            assert_eq!(found.len(), 1, "{nodes} nodes: {found:?}");
            let [x, y] = found[0].position;
            assert!(x.hypot(y) < 1e-8, "{nodes} nodes: {found:?}");
        }
    }

    #[test]
    fn simple_curves_do_not_cross_themselves() {
        for nodes in [8, 65, 256, 4096] {
            assert!(crossings(&Shape::Trillium, nodes).is_empty());
            assert!(crossings(&Shape::Circle { radius: 1e-7 }, nodes).is_empty());
        }
    }

    #[test]
    fn double_curves_cross_as_often_as_they_must() {
        // r = 1 + a cos(kφ/2) over two turns, k odd: the two turns meet k times.
        for lobes in [1, 3, 5] {
            let x = format!("(1 + 0.2*cos({lobes}*phi))*cos(2*phi)");
            let y = format!("(1 + 0.2*cos({lobes}*phi))*sin(2*phi)");
            for nodes in [96, 257, 2048] {
                assert_eq!(crossings(&parametric(&x, &y), nodes).len(), lobes, "{nodes} nodes");
            }
        }
    }

    #[test]
    fn polygons_that_a_ray_sweeps_once_are_not_searched() {
        let swept = |shape: &Shape, nodes: usize| {
            let curve = shape.resample(nodes).unwrap();
            let component = |axis: usize| curve.position.iter().map(|p| p[axis]).collect::<Vec<_>>();
            let [mut x, mut y] = [component(0), component(1)];
            [(); 2].map(|()| {
                x.reverse(); // clockwise, and back
                y.reverse();
                let mut crossings = Crossings::new(nodes);
                crossings.round([&x, &y]) && crossings.is_star_shaped()
            })
        };
        for nodes in [8, 65, 256, 4096] {
            assert_eq!(swept(&Shape::Trillium, nodes), [true; 2]);
            assert_eq!(swept(&Shape::Circle { radius: 1e-7 }, nodes), [true; 2]);
            assert_eq!(swept(&Shape::FigureEight { size: 1.3 }, nodes), [false; 2]);
        }
        assert_eq!(
            swept(&parametric("(2 + cos(phi))*cos(2*phi)", "(2 + cos(phi))*sin(2*phi)"), 96),
            [false; 2]
        );
        // A pentagram turns one way all along, twice around its centre.
        let corner = |i: u32| (TAU * f64::from(2 * i) / 5.0 + 0.1).sin_cos();
        let [x, y] = [(0..5).map(|i| corner(i).1).collect::<Vec<_>>(), (0..5).map(|i| corner(i).0).collect()];
        assert_eq!(Crossings::new(5).count([&x, &y]), 5);
    }

    #[test]
    fn all_pairs_give_the_same() {
        let nodes = 301;
        let x: Vec<f64> = (0..nodes).map(|i| (TAU * 5.0 * i as f64 / 301.0 + 0.3).cos()).collect();
        let y: Vec<f64> = (0..nodes).map(|i| (TAU * 7.0 * i as f64 / 301.0).sin()).collect();
        let mut crossings = Crossings::new(nodes);
        let found = crossings.find([&x, &y]).len();
        let mut all = 0;
        for i in 0..nodes {
            for j in i + 2..nodes - usize::from(i == 0) {
                let node = |k: usize| crossings.node(k % nodes);
                let [a, b, c, d] = [node(i), node(i + 1), node(j), node(j + 1)];
                let crosses = is_left(a, b, c) != is_left(a, b, d) && is_left(c, d, a) != is_left(c, d, b);
                all += usize::from(crosses);
            }
        }
        // A Lissajous curve of 5 and 7 crosses itself 2·5·7 − 5 − 7 times.
        assert_eq!((found, all), (58, 58));
    }

    #[test]
    fn what_is_no_curve_has_no_crossings() {
        for x in [[0.0; 5], [f64::NAN; 5], [0.0, 1.0, f64::INFINITY, 2.0, 3.0]] {
            assert_eq!(Crossings::new(5).count([&x, &x]), 0);
        }
    }
}
