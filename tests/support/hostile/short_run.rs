//! A few steps of any scene, on few nodes.

use flow_core::run::scene::{Frames, Nodes, Spacing};
use flow_core::run::{Quiet, Record, Scene, Simulation, StopReason};

use super::check_message;

/// Enough for every mobility, and few enough to try many scenes.
const NODES: usize = 32;
const STEPS: u64 = 3;
const FRAMES: usize = 4;

/// Sets `scene` up on few nodes and takes a few steps: they succeed, or fail with a message. Returns what there is of
/// the run.
pub fn short_run(mut scene: Scene) -> Option<Record> {
    scene.accuracy.nodes = match scene.accuracy.nodes {
        Nodes::Count(count) => Nodes::Count(count.min(NODES)),
        Nodes::Auto => Nodes::Count(NODES),
    };
    scene.output.frames = match scene.output.frames {
        Frames::Spaced { spacing, .. } => Frames::Spaced { frames: FRAMES, spacing },
        Frames::At { mut times } => {
            times.truncate(FRAMES);
            Frames::At { times }
        }
        _ => Frames::Spaced { frames: FRAMES, spacing: Spacing::Linear },
    };
    scene.time.max_steps = Some(scene.time.max_steps.map_or(STEPS, |most| most.min(STEPS)));
    let mut simulation = match Simulation::new(&scene) {
        Ok(simulation) => simulation,
        Err(error) => {
            check_message(&error);
            return None;
        }
    };
    while simulation.step(&mut Quiet) {}
    let record = simulation.into_record();
    check(&record);
    Some(record)
}

/// Whatever happened, what is kept are numbers, and the reason is a sentence.
fn check(record: &Record) {
    if let StopReason::Failed(message) = &record.stop_reason {
        assert!(!message.is_empty() && !message.chars().any(char::is_control), "{message:?}");
    }
    for frame in &record.frames {
        let numbers = [frame.time, frame.energy, frame.dissipation, frame.length];
        assert!(numbers.into_iter().all(f64::is_finite), "{numbers:?}");
        assert!(frame.curvature.iter().chain(frame.position.as_flattened()).all(|value| value.is_finite()));
    }
    assert!(record.steps.time.windows(2).all(|pair| pair[0] < pair[1]), "{:?}", record.steps.time);
}
