//! The compact Laplacian A⁻¹B of order 4 on a periodic grid: A = (1, 10, 1)/12, B = n²(1, −2, 1). See `THEORY.md`, eq. (O2).

use std::f64::consts::PI;

/// A.
pub const MASS: [f64; 3] = [1.0 / 12.0, 10.0 / 12.0, 1.0 / 12.0];
/// B/n².
pub const DIFFERENCE: [f64; 3] = [1.0, -2.0, 1.0];

/// Symbol of A on a mode of a grid of `nodes` nodes.
pub fn mass_symbol(mode: usize, nodes: usize) -> f64 {
    1.0 - (PI * mode as f64 / nodes as f64).sin().powi(2) / 3.0
}

/// Symbol of −A⁻¹B, per unit parameter, where that of A is `mass`.
pub fn symbol_of_mass(mass: f64, nodes: usize) -> f64 {
    12.0 * (nodes as f64).powi(2) * (1.0 - mass) / mass
}

/// The node before `i`, `i` and the node after it.
pub fn neighbours(i: usize, nodes: usize) -> [usize; 3] {
    [(i + nodes - 1) % nodes, i, (i + 1) % nodes]
}

/// Stencil of the power of A that is `N` nodes wide.
pub fn power_of_mass<const N: usize>() -> [f64; N] {
    let mut power = [0.0; N];
    power[0] = 1.0;
    for _ in 0..N / 2 {
        let before = power;
        power = [0.0; N];
        for (shift, weight) in MASS.iter().enumerate() {
            for (target, value) in power[shift..].iter_mut().zip(before) {
                *target += weight * value;
            }
        }
    }
    power
}
