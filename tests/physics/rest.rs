//! A run ends at rest where the curve is at rest, not where the first fast thing is over.

use curveflow_tests::{assert_close, last, run, shipped};
use flow_core::run::StopReason;

/// The penalty dies at t = 1e-7, the energy then falls from 8.1 to that of a circle in t = 0.1.
#[test]
fn a_stiff_membrane_is_not_at_rest_when_its_stretching_is() {
    for (tolerance, epsilon) in [("1e-5", "1e-8"), ("1e-4", "1e-8"), ("1e-3", "1e-7")] {
        let record = run(&shipped(
            "membrane_penalty",
            &[
                ("density.0.initial", "0.9"),
                ("energy.membrane.epsilon", epsilon),
                ("accuracy.tolerance", tolerance),
                ("time.end", "100"),
                ("time.stop_at_equilibrium", "true"),
            ],
        ));
        assert_eq!(record.stop_reason, StopReason::Equilibrium);
        assert_close(last(&record).energy, 2.804_130, 1e-5);
    }
}

/// The energy at first is a hundred thousand times that of the curve: what is small beside it is not small.
#[test]
fn a_stiff_penalty_on_the_length_is_not_all_there_is() {
    for (penalty, ratio, energy) in [("1e6", "0.9", 2.804_130), ("1e8", "0.99", 2.549_209)] {
        let record = run(&shipped(
            "length_penalty",
            &[
                ("energy.length.penalty", penalty),
                ("energy.length.target_ratio", ratio),
                ("accuracy.tolerance", "1e-2"),
                ("time.end", "20"),
                ("time.stop_at_equilibrium", "true"),
            ],
        ));
        assert_eq!(record.stop_reason, StopReason::Equilibrium);
        assert_close(last(&record).energy, energy, 1e-4);
    }
}

/// On nodes that follow the curve what each remap gives back is lost again until the next one, and steps are as short as rounding makes
/// them: neither goes on for ever.
#[test]
fn nodes_that_follow_the_curve_come_to_rest() {
    for (scene, tolerance, energy, most_steps) in
        [("three_fold", "1e-2", 3.741_577, 1000), ("three_fold_sharp", "1e-3", 4.385_69, 3000)]
    {
        let record = run(&shipped(
            scene,
            &[
                ("flow.gauge", "graded"),
                ("accuracy.tolerance", tolerance),
                ("time.end", "1e8"),
                ("time.stop_at_equilibrium", "true"),
            ],
        ));
        assert_eq!(record.stop_reason, StopReason::Equilibrium);
        assert_close(last(&record).energy, energy, 1e-5);
        assert!(record.counters.steps < most_steps, "{scene}: {} steps", record.counters.steps);
    }
}
