//! Flows that leave a saddle slowly are not at rest on it.

use curveflow_tests::{assert_close, last, run, scene};
use flow_core::run::StopReason;

/// A compressed circle that is a millionth off: for its first steps the energy falls by less than its rounding, and the dissipation, of
/// which little would be lost until the end, is thirty times what it was at first.
#[test]
fn a_saddle_that_begins_to_be_left_is_no_rest() {
    let record = run(&scene(
        "
        curve = { shape = 'ellipse', semi_axes = [1.000001, 1.0] }
        energy = { bending.rigidity = 1.0, length = { penalty = 100.0, target = 9.0 } }
        flow.normal_mobility = 'area-preserving'
        time.end = 100.0
        ",
    ));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    assert_close(last(&record).energy, 6.187_496, 1e-5);
}
