//! Integrals over a curve.

/// Signed enclosed area ½∮(x dy − y dx) of positions with tangents per length, positive counter-clockwise.
/// Trapezoidal rule with dγ = |Γ|wτ ds: `THEORY.md`, eq. (G6).
///
/// # Panics
/// If the components have different numbers of values.
#[must_use]
pub fn enclosed_area(position: [&[f64]; 2], tangent: [&[f64]; 2], length: f64) -> f64 {
    let nodes = position[0].len();
    let alike = [position[1], tangent[0], tangent[1]].iter().all(|values| values.len() == nodes);
    assert!(alike, "positions and tangents have one value per node");
    let sum: f64 = (0..nodes).map(|i| position[0][i] * tangent[1][i] - position[1][i] * tangent[0][i]).sum();
    0.5 * length * sum / nodes as f64
}
