//! Theorem 5 of the paper, measured: the stiff membrane becomes incompressible, and stays cheap.

use curveflow_tests::physics::fit::Slope;
use curveflow_tests::physics::incompressible_limit::{Limit, STARTS, measure};
use curveflow_tests::physics::stiffness;

/// Asserts the orders of ε that the theorem gives: of the distance, the velocity residual and the length deficit.
fn assert_orders(limit: &Limit) {
    for (order, Slope { value, error }) in [2.0, 1.0, 1.0].into_iter().zip(limit.exponents) {
        assert!((value - order).abs() < 0.03, "{value} ± {error} ≠ {order}");
    }
    for point in &limit.points {
        // Rises are rejected above 1e-13.
        assert!(point.rise <= 1e-13, "ε = {:e}: {:.1e}", point.epsilon, point.rise);
        assert!(point.distance[1] < point.distance[0]);
    }
}

#[test]
fn a_membrane_at_rest_moves_as_an_incompressible_one() {
    let limit = measure(STARTS[0].1);
    assert_orders(&limit);
    assert!((limit.exponents[3].value - 1.0).abs() < 0.03, "{}", limit.exponents[3]);
}

/// The rate is the lowest eigenvalue of H.
#[test]
fn a_stretched_membrane_decays_to_the_manifold_at_the_rate_of_the_theorem() {
    let limit = measure(STARTS[1].1);
    assert_orders(&limit);
    for point in &limit.points[5..] {
        let (rate, [first, last]) = (point.rate.expect("a rate"), point.eigenvalues.expect("eigenvalues"));
        let lowest = 0.5 * (first + last);
        assert!((rate.value / lowest - 1.0).abs() < 0.02, "ε = {:e}: {rate}, {lowest}", point.epsilon);
    }
}

#[test]
fn a_membrane_off_the_manifold_comes_to_it() {
    assert_orders(&measure(STARTS[2].1));
}

/// It buckles at first if ε is small: no rate is known then, but where it ends is.
#[test]
fn a_membrane_compressed_everywhere_buckles_and_comes_to_the_manifold() {
    let limit = measure(STARTS[3].1);
    assert_orders(&limit);
    assert_eq!(limit.points[0].buckling, 1.0);
    assert!(limit.points[6].buckling > 4.0, "{}", limit.points[6].buckling);
}

#[test]
fn a_stiff_membrane_on_the_manifold_costs_no_more_steps() {
    let work = stiffness::measure(1e-5);
    let [_, least] = work[0].steps;
    for work in &work {
        println!("ε = {:e}: {:?} steps, {:?}", work.epsilon, work.steps, work.rejections);
        assert!(work.steps[1] <= 2 * least, "ε = {:e}: {} steps", work.epsilon, work.steps[1]);
    }
}
