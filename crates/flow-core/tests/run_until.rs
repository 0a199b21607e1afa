//! Where runs stop when they are asked to, and what they hold then.

use std::ops::ControlFlow;

use flow_core::run::{Observer, Progress, Quiet, Scene, Simulation, StopReason};

fn circle() -> Simulation {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").expect("shipped");
    Simulation::new(&Scene::parse(text, "circle").expect("valid")).expect("a state")
}

/// The shortest steps are longer than that; the run is not over for it.
#[test]
fn a_time_too_near_for_a_step_counts_as_reached() {
    let mut simulation = circle();
    for time in [1e-310, f64::from_bits(1), 0.0, -1.0] {
        assert!(simulation.run_until(time, u64::MAX, &mut Quiet), "{time:e}");
        assert_eq!((simulation.time(), simulation.counters().steps), (0.0, 0));
    }
    assert!(simulation.run_until(1e-300, u64::MAX, &mut Quiet));
    assert_eq!(simulation.time(), 1e-300);
    while simulation.step(&mut Quiet) {}
    assert_ne!(simulation.stop_reason().map(StopReason::name), Some("failed"), "{:?}", simulation.failure());
}

#[test]
#[should_panic(expected = "that is no time")]
fn a_run_until_nan_is_refused() {
    circle().run_until(f64::NAN, u64::MAX, &mut Quiet);
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

/// Stops after every step.
struct Impatient;

impl Observer for Impatient {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn interruptions_that_are_taken_back_leave_no_frames() {
    let (mut whole, mut interrupted) = (circle(), circle());
    while whole.step(&mut Quiet) {}
    while matches!(interrupted.stop_reason(), None | Some(StopReason::Interrupted)) {
        interrupted.go_on();
        assert!(!interrupted.step(&mut Impatient));
        assert_eq!(interrupted.frames().last().map(|frame| frame.time), Some(interrupted.time()));
    }
    assert_eq!(interrupted.stop_reason(), whole.stop_reason());
    let (interrupted, whole) = (interrupted.into_record(), whole.into_record());
    assert_eq!(interrupted.steps, whole.steps);
    assert_eq!(interrupted.frames, whole.frames);
}

#[test]
fn a_run_without_steps_has_its_first_frame_once() {
    let record = circle().into_record();
    assert_eq!(record.stop_reason, StopReason::Interrupted);
    assert_eq!(record.frames.iter().map(|frame| frame.time).collect::<Vec<_>>(), [0.0]);
}
