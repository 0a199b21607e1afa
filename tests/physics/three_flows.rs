//! The last figure of the paper: three ways to hold the length of the trillium.

use curveflow_tests::assert_close;
use curveflow_tests::physics::three_flows::measure;

#[test]
fn the_three_flows_differ_as_in_the_paper() {
    let measured = measure("1e-5", "256");
    let [penalised, membrane, incompressible] = [0, 1, 2].map(|flow: usize| &measured.flows[flow]);
    assert!(incompressible.length_change <= 1e-12, "{:.1e}", incompressible.length_change);
    // Values of runs at the tolerance 1e-8.
    assert_close(penalised.length_ratio, 0.964261, 1e-5);
    assert_close(membrane.length_ratio, 0.975871, 1e-5);
    for flow in &measured.flows {
        assert!(flow.rise <= 1e-14, "{:.1e}", flow.rise);
    }
    // The freer the pieces, the nearer to the circle.
    assert!(penalised.roundness < membrane.roundness && membrane.roundness < incompressible.roundness);

    // "6 roughly equally spaced crossings".
    assert_eq!(measured.aligned.crossings(), 6);
    let directions = measured.aligned.crossing_directions();
    let next = directions.iter().cycle().skip(1);
    for (a, b) in directions.iter().zip(next) {
        let apart = (b - a).rem_euclid(360.0);
        assert!((45.0..75.0).contains(&apart), "{directions:?}");
    }
}

#[test]
fn the_membrane_is_densest_where_the_curve_is_concave() {
    let measured = measure("1e-5", "256");
    // Compressed by O(ε) on average, a peak in each of the three concave arcs.
    assert_close(measured.mean_excess, 0.02473, 1e-3);
    assert_eq!(measured.peaks.len(), 3);
    for [excess, kappa] in &measured.peaks {
        assert!(*excess > 0.02 && *kappa < -0.5, "{excess} at κ = {kappa}");
    }
    assert_close(measured.correlation, -0.7593, 1e-3);
}
