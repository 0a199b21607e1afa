//! Vectors of the state space and its dual: pairing, norms, random motions, differences.

use std::f64::consts::TAU;

use flow_core::geometry::Layout;

/// ⟨a, b⟩ of a dual vector and a motion: the mean over the nodes of each field, and the lengths.
pub fn pair(layout: Layout, a: &[f64], b: &[f64]) -> f64 {
    let last = layout.length_index();
    let fields: f64 = a[..last].iter().zip(&b[..last]).map(|(a, b)| a * b).sum();
    fields / layout.nodes() as f64 + a[last] * b[last]
}

/// √⟨a, a⟩.
pub fn size(layout: Layout, a: &[f64]) -> f64 {
    pair(layout, a, a).sqrt()
}

/// Largest absolute value.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Largest absolute difference.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |largest, (a, b)| (a - b).abs().max(largest))
}

/// y + factor × v.
pub fn moved(y: &[f64], factor: f64, v: &[f64]) -> Vec<f64> {
    y.iter().zip(v).map(|(y, v)| y + factor * v).collect()
}

/// Numbers in [−1, 1) from a seed (the finaliser of `SplitMix64`).
pub fn noise(seed: u64, count: usize) -> Vec<f64> {
    let value = |i: usize| {
        let mut z = seed.wrapping_add((i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2f64.powi(63) - 1.0
    };
    (0..count).map(value).collect()
}

const SMOOTH_MODES: usize = 6;

/// A motion of the state: smooth modes and one mode of any frequency, the sawtooth included.
pub fn motion(layout: Layout, seed: u64) -> Vec<f64> {
    let nodes = layout.nodes();
    let mut motion = Vec::with_capacity(layout.len());
    for field in 0..layout.state_fields() {
        let c = noise(seed ^ (field as u64 + 1), 2 * SMOOTH_MODES + 2);
        let rough = ((0.5 + 0.5 * c[2 * SMOOTH_MODES]) * (nodes / 2 + 1) as f64) as usize;
        motion.extend((0..nodes).map(|i| {
            let s = TAU * i as f64 / nodes as f64;
            let smooth = (0..SMOOTH_MODES).map(|k| {
                let angle = k as f64 * s;
                c[2 * k] * angle.cos() + c[2 * k + 1] * angle.sin()
            });
            smooth.sum::<f64>() + c[2 * SMOOTH_MODES + 1] * (rough as f64 * s).cos()
        }));
    }
    motion.push(noise(seed, 1)[0]);
    motion
}

/// Step of [`difference`]: its error h⁴f⁽⁵⁾/30 and the rounding εf/h are then both near 1e-12 f.
const STEP: f64 = 1e-3;

/// Derivative at 0 by differences of order four.
pub fn difference(mut f: impl FnMut(f64) -> f64) -> f64 {
    (8.0 * (f(STEP) - f(-STEP)) - (f(2.0 * STEP) - f(-2.0 * STEP))) / (12.0 * STEP)
}

/// Derivative at 0 of a vector by differences of order four.
pub fn vector_difference(mut f: impl FnMut(f64) -> Vec<f64>) -> Vec<f64> {
    let [a, b, c, d] = [f(STEP), f(-STEP), f(2.0 * STEP), f(-2.0 * STEP)];
    (0..a.len()).map(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * STEP)).collect()
}
