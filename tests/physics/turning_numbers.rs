//! Curves that turn otherwise than once.

use std::f64::consts::{FRAC_PI_2, PI};

use curveflow_tests::{assert_close, bisection, largest_rise, last, mean, run, scene, shipped};
use flow_core::run::{Frame, Record, StopReason};

/// Turns of the tangent along the curve.
fn turns(frame: &Frame) -> f64 {
    mean(&frame.curvature) * frame.length / (2.0 * PI)
}

/// Checks what holds for every curve that crosses itself once.
fn keeps_its_turns(record: &Record, expected: f64) {
    for frame in &record.frames {
        assert!((turns(frame) - expected).abs() < 1e-12, "{}", turns(frame));
    }
    // Rounding of sums of a thousand terms.
    assert!(largest_rise(record) < 1e-12, "{:.1e}", largest_rise(record));
}

/// Complete elliptic integrals K and E of the parameter m, by the arithmetic-geometric mean.
fn elliptic_integrals(m: f64) -> [f64; 2] {
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

/// (½∫κ² dσ)|Γ| of the figure eight among Euler's elastica.
///
/// κ = 2k√λ cn(√λσ, k) has the period 4K/√λ, after which the curve has moved on by 4(2E − K)/√λ: it closes where 2E = K.
/// ½∫κ² dσ = 8√λ(E − (1 − k²)K), so that the product is 32K(E − (1 − k²)K).
fn figure_eight_elastica() -> f64 {
    let m = bisection([0.5, 0.99], |m| {
        let [k, e] = elliptic_integrals(m);
        k - 2.0 * e
    });
    let [k, e] = elliptic_integrals(m);
    32.0 * k * (e - (1.0 - m) * k)
}

#[test]
fn elliptic_integrals_are_the_tabulated_ones() {
    let [k, e] = elliptic_integrals(0.5);
    assert_close(k, 1.854074677301372, 1e-14);
    assert_close(e, 1.350643881047675, 1e-14);
}

#[test]
fn a_figure_eight_becomes_the_elastica() {
    let record = run(&shipped("figure_eight", &[("accuracy.tolerance", "1e-8")]));
    keeps_its_turns(&record, 0.0);
    assert!(record.frames.iter().all(|frame| frame.crossings == 1.0));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    let end = last(&record);
    assert_close(end.energy_terms[0] * end.length, figure_eight_elastica(), 1e-6);
    assert!(end.area.abs() < 1e-9);
}

#[test]
fn a_curve_that_turns_twice_becomes_a_double_circle() {
    for curve in [
        "shape = 'polar', r = '0.5 + cos(phi)'",
        "shape = 'parametric', x = '(1 + 0.2*cos(phi))*cos(2*phi)', y = '(1 + 0.2*cos(phi))*sin(2*phi)'",
    ] {
        let record = run(&scene(&format!(
            "
            curve = {{ {curve}, turning_number = 2 }}
            energy.bending.rigidity = 1.0
            energy.length = {{ penalty = 10.0, target_ratio = 1.0 }}
            time = {{ end = 100.0 }}
            accuracy = {{ tolerance = 1e-7, nodes = 256 }}
            "
        )));
        keeps_its_turns(&record, 2.0);
        assert_eq!(record.stop_reason, StopReason::Equilibrium, "{curve}");
        assert_eq!(record.frames[0].crossings, 1.0, "{curve}");
        let end = last(&record);
        // κ = 4π/|Γ| everywhere.
        assert_close(end.energy_terms[0] * end.length, 8.0 * PI * PI, 1e-6);
    }
}
