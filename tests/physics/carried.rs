//! Densities that are only carried along, over nodes that slide on the curve.

use curveflow_tests::{run, scene};
use flow_core::run::StopReason;

/// Its waves pass the nodes undamped. Without their transport in the implicit operator this run took 374, 1,238 and 320 steps, on graded
/// nodes 2,719, 3,956 and 6,100; with formulas of high order that multiply them, 10,368 nodes for noise.
#[test]
fn waves_of_a_carried_density_take_no_more_steps_than_others() {
    for gauge in ["scaled-arc-length", "graded"] {
        for (tolerance, steps) in [(1e-2_f64, 150), (1e-3, 250), (1e-5, 450)] {
            let record = run(&scene(&format!(
                "
                curve.shape = 'figure-eight'
                density = [{{ name = 'u', initial = '0.866 + 0.1*cos(2*pi*s) + 0.07*cos(10*pi*s + 4.3)', mobility = 'none' }}]
                [energy.agents]
                density = 'u'
                epsilon = 0.15
                delta = 0.16
                preferred_curvature = '-0.5 - rho'
                low_density = 0.05
                high_density = 0.85
                [flow]
                gauge = '{gauge}'
                [time]
                end = 1.0
                max_steps = {steps}
                [accuracy]
                tolerance = {tolerance}
                "
            )));
            let energy = record.frames.last().expect("a frame").energy;
            println!("{gauge}, {tolerance:.0e}: {energy}, {:?}", record.counters);
            assert_eq!(record.stop_reason, StopReason::EndTime, "{gauge}, {tolerance:.0e}");
            assert!(
                (energy / 46.225416 - 1.0).abs() < 4.0 * tolerance.max(1e-4),
                "{gauge}, {tolerance:.0e}: {energy}"
            );
            assert!(record.counters.rejections.solver <= 5, "{:?}", record.counters.rejections);
        }
    }
}
