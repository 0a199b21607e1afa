//! Modes about a circle under an energy of positions: none may grow on the grid that does not grow in the plane.

use std::f64::consts::TAU;

use flow_core::energies::{Area, EnergyTerm, Length};
use flow_core::geometry::Layout;
use flow_core::operators::DerivativeFamily;
use nalgebra::DMatrix;

use crate::terms::flow_of;

const RADIUS: f64 = 1.5;

/// Largest real part of the eigenvalues of the flow of `terms`, linearised about a circle by differences.
fn largest_growth(terms: Vec<Box<dyn EnergyTerm>>, family: DerivativeFamily, nodes: usize) -> f64 {
    const STEP: f64 = 1e-5;
    let layout = Layout::new(nodes, 0);
    let mut circle = vec![TAU; nodes];
    circle.push(TAU * RADIUS);
    let mut flow = flow_of(terms, family, layout);
    let size = layout.len();
    let mut jacobian = DMatrix::<f64>::zeros(size, size);
    let [mut above, mut below] = [vec![0.0; size], vec![0.0; size]];
    for column in 0..size {
        for (rate, step) in [(&mut above, STEP), (&mut below, -STEP)] {
            let mut moved = circle.clone();
            moved[column] += step;
            flow.rate(&moved, rate);
        }
        for row in 0..size {
            jacobian[(row, column)] = (above[row] - below[row]) / (2.0 * STEP);
        }
    }
    jacobian.complex_eigenvalues().iter().fold(f64::NEG_INFINITY, |largest, value| value.re.max(largest))
}

/// V = p − σκ: mode n has the rate −σ(n² − 1)/R², so that the circle itself grows fastest, whatever p is. The sawtooth
/// grows like n² if pressure does not feel it.
#[test]
fn pressure_makes_no_mode_grow() {
    let bound = 1.001 / (RADIUS * RADIUS);
    for family in DerivativeFamily::ALL {
        for nodes in [16, 17, 32] {
            let terms: Vec<Box<dyn EnergyTerm>> =
                vec![Box::new(Area::Pressure(1.0)), Box::new(Length::Tension(1.0))];
            let growth = largest_growth(terms, family, nodes);
            // Second-order differences see the circle itself to (π/n)².
            let error = if family == DerivativeFamily::Central2 { 1.03 } else { 1.0 };
            assert!(growth <= error * bound, "{family:?}, n = {nodes}: {growth}");
        }
    }
    for nodes in [16, 17, 32] {
        let growth = largest_growth(vec![Box::new(Area::Pressure(1.0))], DerivativeFamily::Fourier, nodes);
        assert!(growth <= 1e-4, "n = {nodes}: {growth}");
    }
}
