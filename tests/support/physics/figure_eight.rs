//! Curves that turn otherwise than once: the figure eight among Euler's elastica, and the double circle.

use std::f64::consts::{FRAC_PI_2, PI};

use flow_core::run::{Frame, Record};

use crate::{bisection, last, mean, run, scene, shipped};

/// Complete elliptic integrals K and E of the parameter m, by the arithmetic-geometric mean.
#[must_use]
pub fn elliptic_integrals(m: f64) -> [f64; 2] {
    let (mut a, mut b, mut weight) = (1.0, (1.0 - m).sqrt(), 1.0);
    let mut sum = 0.5 * m;
    while a - b > 1e-15 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += weight * c * c;
        weight *= 2.0;
    }
    let k = FRAC_PI_2 / a;
    [k, k * (1.0 - sum)]
}

/// Parameter m = k² at which 2E = K.
#[must_use]
pub fn parameter() -> f64 {
    bisection([0.5, 0.99], |m| {
        let [k, e] = elliptic_integrals(m);
        k - 2.0 * e
    })
}

/// (½∫κ² dσ)|Γ| of the figure eight among Euler's elastica.
///
/// κ = 2k√λ cn(√λσ, k) has the period 4K/√λ, after which the curve has moved on by 4(2E − K)/√λ: it closes where 2E = K.
/// ½∫κ² dσ = 8√λ(E − (1 − k²)K), so that the product is 32K(E − (1 − k²)K).
#[must_use]
pub fn elastica() -> f64 {
    let m = parameter();
    let [k, e] = elliptic_integrals(m);
    32.0 * k * (e - (1.0 - m) * k)
}

/// Turns of the tangent along the curve.
#[must_use]
pub fn turns(frame: &Frame) -> f64 {
    mean(&frame.curvature) * frame.length / (2.0 * PI)
}

/// Largest distance of the turns from `expected` over all frames.
#[must_use]
pub fn turns_off(record: &Record, expected: f64) -> f64 {
    record.frames.iter().map(|frame| (turns(frame) - expected).abs()).fold(0.0, f64::max)
}

/// (½∫κ² dσ)|Γ| at the end, the bending energy being the first term.
#[must_use]
pub fn product(record: &Record) -> f64 {
    let end = last(record);
    end.energy_terms[0] * end.length
}

/// The shipped figure eight, run to rest.
#[must_use]
pub fn figure_eight(tolerance: &str) -> Record {
    run(&shipped("figure_eight", &[("accuracy.tolerance", tolerance)]))
}

/// Two curves that turn twice.
pub const DOUBLE: [(&str, &str); 2] = [
    ("limaçon", "shape = 'polar', r = '0.5 + cos(phi)'"),
    (
        "wound circle",
        "shape = 'parametric', x = '(1 + 0.2*cos(phi))*cos(2*phi)', y = '(1 + 0.2*cos(phi))*sin(2*phi)'",
    ),
];

/// A curve that turns twice, run to rest.
#[must_use]
pub fn double_circle(curve: &str) -> Record {
    run(&scene(&format!(
        "
        curve = {{ {curve}, turning_number = 2 }}
        energy.bending.rigidity = 1.0
        energy.length = {{ penalty = 10.0, target_ratio = 1.0 }}
        time = {{ end = 100.0 }}
        accuracy = {{ tolerance = 1e-7, nodes = 256 }}
        "
    )))
}
