//! Curvature agents: ∫ (δ/2)|∇_sκ|² + f/δ + (ε/2)|∇_sρ|² + F/ε dσ with f = ½(κ − κ₀(ρ))² and
//! F = 4(ρ − ρ₋(κ))²(ρ − ρ₊(κ))². See `THEORY.md`, eq. (E4).

use std::cmp::Ordering;

use super::differentiated::Differentiated;
use super::{EnergyTerm, Fields, Jet, Order, TermFault};
use crate::expression::{Expression, ExpressionError};

/// The nodal functions of the potentials, as expressions of one variable each.
#[derive(Clone, Debug)]
pub struct NodalLines {
    /// κ₀(ρ).
    pub preferred_curvature: Expression,
    /// ρ₋(κ).
    pub low_density: Expression,
    /// ρ₊(κ).
    pub high_density: Expression,
}

/// Energy of one density that prefers curvatures.
#[derive(Clone, Debug)]
pub struct Agents {
    field: usize,
    epsilon: f64,
    delta: f64,
    functions: Differentiated,
    /// κ₀, κ₀′, ρ₋, ρ₋′, ρ₊, ρ₊′ and then κ₀″, ρ₋″, ρ₊″ at the nodes.
    lines: [Vec<f64>; LINES],
}

const LINES: usize = 9;

impl Agents {
    /// Agents on density `density` (counted from 0) with widths ε, δ > 0, for `nodes` nodes.
    ///
    /// In `lines`, variable 0 is κ and variable 1 is ρ.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative of a nodal line is too large.
    pub fn new(
        density: usize,
        epsilon: f64,
        delta: f64,
        lines: &NodalLines,
        nodes: usize,
    ) -> Result<Self, ExpressionError> {
        let NodalLines { preferred_curvature, low_density, high_density } = lines;
        let functions = [(preferred_curvature, 1), (low_density, 0), (high_density, 0)];
        Ok(Self {
            field: 1 + density,
            epsilon,
            delta,
            functions: Differentiated::along(&functions)?,
            lines: std::array::from_fn(|_| vec![0.0; nodes]),
        })
    }
}

impl EnergyTerm for Agents {
    fn name(&self) -> &'static str {
        "agents"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn stiffness(&self, field: usize) -> f64 {
        match field {
            0 => self.delta,
            _ if field == self.field => self.epsilon,
            _ => 0.0,
        }
    }

    fn fault(&self, fields: Fields<'_>) -> Option<TermFault> {
        let [_, _, low, _, high, ..] = &self.lines;
        let node =
            low.iter().zip(high).position(|(low, high)| low.partial_cmp(high) != Some(Ordering::Less))?;
        let curvature = fields.get(0)[node];
        Some(TermFault::NodalLinesMeet { node, curvature, low: low[node], high: high[node] })
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let (kappa, rho) = (fields.get(0), fields.get(self.field));
        let mut outputs = self.lines.each_mut().map(Vec::as_mut_slice);
        self.functions.evaluate(jet.order(), &[kappa, rho], &mut outputs);
        let lines = self.lines.each_ref().map(Vec::as_slice);
        add_gradient(self.field, [self.epsilon, self.delta], kappa, rho, lines, jet);
        if jet.order() >= Order::Hessian {
            add_hessian(self.field, [self.epsilon, self.delta], kappa, rho, lines, jet);
        }
    }
}

/// e, `e_κ` and `e_ρ`. With u = ρ − ρ₋, v = ρ − ρ₊: F = 4u²v², `F_ρ` = 8uv(u + v), `F_κ` = −8uv(ρ₋′v + ρ₊′u).
fn add_gradient(
    field: usize,
    [epsilon, delta]: [f64; 2],
    kappa: &[f64],
    rho: &[f64],
    [preferred, preferred_1, low, low_1, high, high_1, ..]: [&[f64]; LINES],
    jet: &mut Jet,
) {
    let (by_delta, by_epsilon) = (1.0 / delta, 1.0 / epsilon);
    let nodes = rho.len();
    let (value, by_kappa) = jet.value_and_first_mut(0);
    for i in 0..nodes {
        let (u, v, excess) = (rho[i] - low[i], rho[i] - high[i], kappa[i] - preferred[i]);
        let uv = u * v;
        value[i] += 0.5 * by_delta * excess * excess + 4.0 * by_epsilon * uv * uv;
        by_kappa[i] += by_delta * excess - 8.0 * by_epsilon * uv * (low_1[i] * v + high_1[i] * u);
    }
    let by_rho = jet.first_mut(field);
    for i in 0..nodes {
        let (u, v, excess) = (rho[i] - low[i], rho[i] - high[i], kappa[i] - preferred[i]);
        by_rho[i] += 8.0 * by_epsilon * u * v * (u + v) - by_delta * excess * preferred_1[i];
    }
}

/// `e_κκ`, `e_κρ` and `e_ρρ`.
fn add_hessian(
    field: usize,
    [epsilon, delta]: [f64; 2],
    kappa: &[f64],
    rho: &[f64],
    [preferred, preferred_1, low, low_1, high, high_1, preferred_2, low_2, high_2]: [&[f64]; LINES],
    jet: &mut Jet,
) {
    let (by_delta, by_epsilon) = (1.0 / delta, 8.0 / epsilon);
    let nodes = rho.len();
    let kappa_kappa = jet.second_mut(0, 0);
    for i in 0..nodes {
        let (u, v) = (rho[i] - low[i], rho[i] - high[i]);
        let slope = low_1[i] * v + high_1[i] * u;
        let bend = low_2[i] * v + high_2[i] * u - 2.0 * low_1[i] * high_1[i];
        kappa_kappa[i] += by_delta + by_epsilon * (slope * slope - u * v * bend);
    }
    let kappa_rho = jet.second_mut(0, field);
    for i in 0..nodes {
        let (u, v) = (rho[i] - low[i], rho[i] - high[i]);
        let slope = low_1[i] * v + high_1[i] * u;
        kappa_rho[i] -=
            by_delta * preferred_1[i] + by_epsilon * ((u + v) * slope + u * v * (low_1[i] + high_1[i]));
    }
    let rho_rho = jet.second_mut(field, field);
    for i in 0..nodes {
        let (u, v, excess) = (rho[i] - low[i], rho[i] - high[i], kappa[i] - preferred[i]);
        rho_rho[i] += by_epsilon * ((u + v) * (u + v) + 2.0 * u * v)
            + by_delta * (preferred_1[i] * preferred_1[i] - excess * preferred_2[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is wrong with nodal lines on the curvatures 1, 0 and 2.
    fn fault(low: &str, high: &str) -> Option<TermFault> {
        let line = |text| Expression::parse(text, &["kappa", "rho"]).unwrap();
        let lines =
            NodalLines { preferred_curvature: line("rho"), low_density: line(low), high_density: line(high) };
        let mut agents = Agents::new(0, 0.1, 0.1, &lines, 3).unwrap();
        let values = [1.0, 0.0, 2.0, 0.5, 0.5, 0.5];
        let (fields, mut jet) = (Fields::new(3, &values), Jet::new(3, 2));
        jet.clear(Order::Gradient);
        agents.add_density(fields, &mut jet);
        agents.fault(fields)
    }

    #[test]
    fn nodal_lines_that_touch_cross_or_are_no_numbers_are_found_at_their_node() {
        let node = |low, high| match fault(low, high) {
            Some(TermFault::NodalLinesMeet { node, .. }) => Some(node),
            _ => None,
        };
        assert_eq!(node("0.2", "0.3 + 0.1*kappa"), None);
        assert_eq!(node("0.2", "0.2 + 0.1*kappa"), Some(1));
        assert_eq!(node("0.2", "0.5 - 0.2*kappa"), Some(2));
        assert_eq!(node("0.2", "sqrt(kappa - 0.5)"), Some(1));
        assert_eq!(node("0*ln(kappa)", "0.8"), Some(1));
    }
}
