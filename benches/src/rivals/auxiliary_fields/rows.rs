//! The rows of (I − γJ)x = r by second differences. See `THEORY.md`, eqs. (D5), (F1)–(F3) and (F7).
//!
//! With u = x/L for the fields, λ = x/L for the length, q = (n/L)² and S = (−1, 2, −1):
//!
//! ```text
//! u_κ − γqSV − γ(n/L)δ(κW) = r_κ/L      p = Hess·(u, λ)           V + qSp_κ − κZ − t(u_κ − κλ) = 0
//! u_ρ + γ𝓖p_ρ − γ(n/L)δ(ρW) = r_ρ/L     δZ − Σφδp + ζ/n = 0       δW + (L/n)κV − η/n = 0
//! ```
//!
//! t = Z − π at the frozen state, see (F20). λ, ζ, η and the last values of Z and W are in the border.

use flow_core::flow::GradientFlow;

use super::band::Band;
use super::places::Places;

/// A field at the midpoint after `node`.
pub fn after(field: &[f64], node: usize) -> f64 {
    f64::midpoint(field[node], field[(node + 1) % field.len()])
}

/// −δ²f at `node`.
pub fn minus_second_difference(field: &[f64], node: usize) -> f64 {
    let n = field.len();
    2.0 * field[node] - field[(node + n - 1) % n] - field[(node + 1) % n]
}

/// Fills in the band at the frozen state of `flow`.
pub fn fill(flow: &GradientFlow, places: Places, gamma: f64, band: &mut dyn Band) {
    band.clear();
    let mut row = Row { flow, places, gamma, entries: Vec::with_capacity(32) };
    for node in 0..places.nodes {
        for field in 0..places.fields {
            row.motion(field, node);
            row.pass(places.motion(field, node), band);
            row.gradient(field, node);
            row.pass(places.gradient(field, node), band);
        }
        row.velocity(node);
        row.pass(places.velocity(node), band);
        row.adjoint(node);
        row.pass(places.adjoint(node), band);
        row.tangential(node);
        row.pass(places.tangential(node), band);
    }
}

/// One row while it grows.
struct Row<'a> {
    flow: &'a GradientFlow,
    places: Places,
    gamma: f64,
    entries: Vec<(usize, f64)>,
}

impl Row<'_> {
    fn pass(&mut self, row: usize, band: &mut dyn Band) {
        band.set_row(row, &self.entries);
        self.entries.clear();
    }

    fn add(&mut self, column: usize, value: f64) {
        self.entries.push((column, value));
    }

    /// `weights` times the unknown that `place` finds at the node before, at the node, and after it.
    fn add_three(&mut self, node: usize, weights: [f64; 3], place: impl Fn(usize) -> usize) {
        let [before, next] = self.places.neighbours(node);
        for (node, weight) in [before, node, next].into_iter().zip(weights) {
            self.add(place(node), weight);
        }
    }

    fn length(&self) -> f64 {
        self.flow.frozen().length()
    }

    /// q S.
    fn minus_laplacian(&self) -> [f64; 3] {
        let square = (self.places.nodes as f64 / self.length()).powi(2);
        [-square, 2.0 * square, -square]
    }

    fn motion(&mut self, field: usize, node: usize) {
        let (places, gamma, length) = (self.places, self.gamma, self.length());
        self.add(places.motion(field, node), 1.0);
        if field == 0 {
            let weights = self.minus_laplacian().map(|weight| -gamma * weight);
            self.add_three(node, weights, |node| places.velocity(node));
        } else {
            let mobility = &self.flow.density_mobilities()[field - 1];
            let weights =
                mobility.three_points(self.flow.frozen(), node, places.nodes).map(|weight| gamma * weight);
            self.add_three(node, weights, |node| places.gradient(field, node));
        }
        let [before, _] = places.neighbours(node);
        let (phi, scale) = (self.flow.frozen().at_nodes(field), gamma * places.nodes as f64 / length);
        self.add(places.tangential(node), -scale * after(phi, node));
        self.add(places.tangential(before), scale * after(phi, before));
    }

    fn gradient(&mut self, field: usize, node: usize) {
        let places = self.places;
        self.add(places.gradient(field, node), 1.0);
        for other in 0..places.fields {
            let second = self.flow.energy_terms().jet().second(field, other)[node];
            self.add(places.motion(other, node), -second);
        }
        let stiffness = self.flow.energy_terms().stiffness()[field];
        let weights = self.minus_laplacian().map(|weight| -stiffness * weight);
        self.add_three(node, weights, |node| places.motion(field, node));
    }

    fn velocity(&mut self, node: usize) {
        let places = self.places;
        self.add(places.velocity(node), 1.0);
        self.add_three(node, self.minus_laplacian(), |node| places.gradient(0, node));
        self.add(places.adjoint(node), -self.flow.frozen().at_nodes(0)[node]);
        self.add(places.motion(0, node), -self.flow.frozen_stretching()[node]);
    }

    /// The last row sets Z to a value of the border, which has the row left out.
    fn adjoint(&mut self, node: usize) {
        let places = self.places;
        if node + 1 == places.nodes {
            self.add(places.adjoint(node), 1.0);
            return;
        }
        for (column, value) in adjoint_row(self.flow, places, node) {
            self.add(column, value);
        }
    }

    /// As [`Row::adjoint`], for W.
    fn tangential(&mut self, node: usize) {
        let places = self.places;
        if node + 1 == places.nodes {
            self.add(places.tangential(node), 1.0);
            return;
        }
        for (column, value) in tangential_row(self.flow, places, node) {
            self.add(column, value);
        }
    }
}

/// δZ − Σφδp at the midpoint after `node`.
pub fn adjoint_row(
    flow: &GradientFlow,
    places: Places,
    node: usize,
) -> impl Iterator<Item = (usize, f64)> + use<'_> {
    let [_, next] = places.neighbours(node);
    let gradients = (0..places.fields).flat_map(move |field| {
        let phi = after(flow.frozen().at_nodes(field), node);
        [(places.gradient(field, next), -phi), (places.gradient(field, node), phi)]
    });
    [(places.adjoint(next), 1.0), (places.adjoint(node), -1.0)].into_iter().chain(gradients)
}

/// δW + (L/n)κV at `node`.
pub fn tangential_row(flow: &GradientFlow, places: Places, node: usize) -> [(usize, f64); 3] {
    let [before, _] = places.neighbours(node);
    let stretch = flow.frozen().length() / places.nodes as f64 * flow.frozen().at_nodes(0)[node];
    [(places.tangential(node), 1.0), (places.tangential(before), -1.0), (places.velocity(node), stretch)]
}
