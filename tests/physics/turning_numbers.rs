//! Curves that turn otherwise than once.

use std::f64::consts::PI;

use curveflow_tests::physics::figure_eight::{
    DOUBLE, double_circle, elastica, elliptic_integrals, figure_eight, product, turns_off,
};
use curveflow_tests::{assert_close, largest_rise, last};
use flow_core::run::{Record, StopReason};

/// Checks what holds for every curve that crosses itself once.
fn keeps_its_turns(record: &Record, expected: f64) {
    assert!(turns_off(record, expected) < 1e-12, "{:.1e}", turns_off(record, expected));
    // Rounding of sums of a thousand terms.
    assert!(largest_rise(record) < 1e-12, "{:.1e}", largest_rise(record));
}

#[test]
fn elliptic_integrals_are_the_tabulated_ones() {
    let [k, e] = elliptic_integrals(0.5);
    assert_close(k, 1.854074677301372, 1e-14);
    assert_close(e, 1.350643881047675, 1e-14);
}

#[test]
fn a_figure_eight_becomes_the_elastica() {
    let record = figure_eight("1e-8");
    keeps_its_turns(&record, 0.0);
    assert!(record.frames.iter().all(|frame| frame.crossings == 1.0));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert_close(product(&record), elastica(), 1e-6);
    assert!(last(&record).area.abs() < 1e-9);
}

#[test]
fn a_curve_that_turns_twice_becomes_a_double_circle() {
    for (name, curve) in DOUBLE {
        let record = double_circle(curve);
        keeps_its_turns(&record, 2.0);
        assert_eq!(record.stop_reason, StopReason::Equilibrium, "{name}");
        assert_eq!(record.frames[0].crossings, 1.0, "{name}");
        // κ = 4π/|Γ| everywhere.
        assert_close(product(&record), 8.0 * PI * PI, 1e-6);
    }
}
