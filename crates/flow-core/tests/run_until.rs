//! Where runs stop when they are asked to.

use flow_core::run::{Quiet, Scene, Simulation, StopReason};

/// The shortest steps are longer than that; the run is not over for it.
#[test]
fn a_time_too_near_for_a_step_counts_as_reached() {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").expect("shipped");
    let mut simulation = Simulation::new(&Scene::parse(text, "circle").unwrap()).unwrap();
    for time in [1e-310, f64::from_bits(1), 0.0, -1.0] {
        assert!(simulation.run_until(time, u64::MAX, &mut Quiet), "{time:e}");
        assert_eq!((simulation.time(), simulation.counters().steps), (0.0, 0));
    }
    assert!(simulation.run_until(1e-300, u64::MAX, &mut Quiet));
    assert_eq!(simulation.time(), 1e-300);
    while simulation.step(&mut Quiet) {}
    assert_ne!(simulation.stop_reason().map(StopReason::name), Some("failed"), "{:?}", simulation.failure());
}

/// Sums of times end a unit in the last place away: 0.1·3 is not 0.3.
#[test]
fn a_time_within_the_rounding_of_the_present_one_counts_as_reached() {
    for name in ["three_fold", "blend", "circle"] {
        let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
        let mut simulation = Simulation::new(&Scene::parse(text, name).unwrap()).unwrap();
        for time in [0.1, 0.3, 0.1 * 3.0, 0.3_f64.next_up(), 0.4, 0.4 * (1.0 + 1e-14), 0.41] {
            assert!(
                simulation.run_until(time, u64::MAX, &mut Quiet),
                "{name} {time}: {:?}",
                simulation.failure()
            );
            assert!((simulation.time() - time).abs() <= 16.0 * f64::EPSILON * time, "{name} {time}");
        }
    }
}
