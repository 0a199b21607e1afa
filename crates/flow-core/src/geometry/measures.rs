//! Integrals over a curve.

/// Signed enclosed area ½∮(x dy − y dx) of positions with tangents, positive counter-clockwise.
/// Trapezoidal rule with dγ = |Γ|τ ds: `THEORY.md`, eq. (G6).
#[must_use]
pub fn enclosed_area(position: [&[f64]; 2], tangent: [&[f64]; 2], length: f64) -> f64 {
    let nodes = position[0].len();
    let sum: f64 = (0..nodes).map(|i| position[0][i] * tangent[1][i] - position[1][i] * tangent[0][i]).sum();
    0.5 * length * sum / nodes as f64
}

const LANES: usize = 8;

/// Sum of products in eight independent lanes, which the compiler turns into vector registers.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a_chunks, b_chunks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_chunks.zip(b_chunks) {
        for k in 0..LANES {
            lanes[k] += a[k] * b[k];
        }
    }
    rest + ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]))
}

/// Sum in eight independent lanes.
#[must_use]
pub fn sum(values: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let chunks = values.chunks_exact(LANES);
    let rest: f64 = chunks.remainder().iter().sum();
    for chunk in chunks {
        for k in 0..LANES {
            lanes[k] += chunk[k];
        }
    }
    rest + ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]))
}
