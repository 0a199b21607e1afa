//! Area: pressure −pA or penalty (β/2)(A − A*)². See `THEORY.md`, eq. (E6).

use super::{EnergyTerm, Order, ShapeFields};
use crate::geometry::enclosed_area;

/// Energy of the enclosed (signed) area A.
#[derive(Clone, Debug)]
pub enum Area {
    /// Pressure p, in energy per area: the energy is −pA, so that p > 0 inflates.
    Pressure(f64),
    /// Penalty on the distance from the target area A*.
    Penalty {
        /// Penalty β ≥ 0, in energy per area².
        penalty: f64,
        /// Target area A*.
        target: f64,
    },
}

impl Area {
    /// Value, first and second derivative by the area.
    fn of_area(&self, area: f64) -> [f64; 3] {
        match *self {
            Self::Pressure(pressure) => [-pressure * area, -pressure, 0.0],
            Self::Penalty { penalty, target } => {
                let excess = area - target;
                [0.5 * penalty * excess * excess, penalty * excess, penalty]
            }
        }
    }
}

fn area(shape: &ShapeFields) -> f64 {
    enclosed_area(shape.positions(), shape.tangents(), shape.length)
}

/// `½⟨xτ_y − yτ_x⟩` of the positions of one and the tangents of another.
fn per_length(position: &ShapeFields, tangent: &ShapeFields) -> f64 {
    enclosed_area(position.positions(), tangent.tangents(), 1.0)
}

/// Adds `factor` times the derivative of `½⟨xτ_y − yτ_x⟩` at `shape` by positions and tangents.
fn add_derivative(shape: &ShapeFields, factor: f64, out: &mut ShapeFields) {
    let half = 0.5 * factor;
    let (position, tangent) = (&shape.position, &shape.tangent);
    for i in 0..position[0].len() {
        out.position[0][i] += half * tangent[1][i];
        out.position[1][i] -= half * tangent[0][i];
        out.tangent[0][i] -= half * position[1][i];
        out.tangent[1][i] += half * position[0][i];
    }
}

impl EnergyTerm for Area {
    fn name(&self) -> &'static str {
        "area"
    }

    fn has_shape_energy(&self) -> bool {
        true
    }

    fn cost_of_area(&self, area: f64) -> Option<f64> {
        Some(self.of_area(area)[0])
    }

    fn add_shape_energy(&mut self, shape: &ShapeFields, _: Order, out: &mut ShapeFields) -> f64 {
        let area = area(shape);
        let [value, first, _] = self.of_area(area);
        add_derivative(shape, first * shape.length, out);
        out.length += first * area / shape.length;
        value
    }

    fn add_shape_hessian_product(&mut self, at: &ShapeFields, motion: &ShapeFields, out: &mut ShapeFields) {
        let area = area(at);
        let [_, first, second] = self.of_area(area);
        let change_per_length = per_length(motion, at) + per_length(at, motion);
        let change = at.length * change_per_length + motion.length * area / at.length;
        add_derivative(at, second * change * at.length + first * motion.length, out);
        add_derivative(motion, first * at.length, out);
        out.length += second * change * area / at.length + first * change_per_length;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn of_a_circle() {
        let (n, radius) = (32, 1.7);
        let mut circle = ShapeFields { length: TAU * radius, ..ShapeFields::new(n) };
        for i in 0..n {
            let (sine, cosine) = (TAU * i as f64 / n as f64).sin_cos();
            (circle.position[0][i], circle.position[1][i]) = (radius * cosine, radius * sine);
            (circle.tangent[0][i], circle.tangent[1][i]) = (-sine, cosine);
        }
        let mut out = ShapeFields::new(n);
        let energy = Area::Pressure(0.5).add_shape_energy(&circle, Order::Gradient, &mut out);
        assert!((energy + 0.5 * PI * radius * radius).abs() < 1e-14 * radius * radius);
    }
}
