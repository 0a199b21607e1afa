//! Densities that exchange with the surroundings.

use curveflow_tests::{last, run, scene};
use flow_core::run::StopReason;

/// A circle that shrinks under tension, whose density follows the curvature: two ordinary differential equations, which give the energy
/// 0.218203 at the end. What linear solves left of the density grew from step to step: 1,224 and 9,257 of them, and an end that was off.
#[test]
fn what_solves_leave_of_a_density_that_exchanges_does_not_grow() {
    for (tolerance, steps) in [(1e-2, 100), (1e-3, 120), (1e-5, 250)] {
        let record = run(&scene(&format!(
            "
            curve = {{ shape = 'circle', radius = 1.0 }}
            density = [{{ name = 'a', initial = 0.3, mobility = 'exchange' }}]
            energy.bending = {{ rigidity = 2.5, preferred_curvature = '0.84*rho' }}
            energy.local.expression = '0.022*a_sigma^2'
            energy.length.tension = 0.5
            time = {{ end = 2.0, max_steps = {steps} }}
            accuracy.tolerance = {tolerance}
            "
        )));
        let energy = last(&record).energy;
        println!("{tolerance:.0e}: {energy}, {:?}", record.counters);
        assert_eq!(record.stop_reason, StopReason::EndTime, "{tolerance:.0e}");
        assert!((energy / 0.218203 - 1.0).abs() < 10.0 * tolerance, "{tolerance:.0e}: {energy}");
    }
}
