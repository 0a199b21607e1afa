//! What `curveflow check` foretells, held against the runs themselves.

use flow_core::run::scene::{Frames, Nodes, OutputField, Spacing};
use flow_core::run::{Prediction, Quiet, Record, Scene, SetupError, StopReason, predict, run};

fn shipped(name: &str) -> Scene {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    Scene::parse(text, name).expect("valid")
}

fn both(scene: &Scene) -> (Prediction, Record) {
    (predict(scene).expect("an initial state"), run(scene, &mut Quiet).expect("an initial state"))
}

fn assert_near(predicted: f64, taken: f64, factor: f64, what: &str) {
    assert!(
        predicted < factor * taken && taken < factor * predicted,
        "{what}: {predicted} foretold, {taken} taken"
    );
}

#[test]
fn steps_and_nodes_of_the_shipped_scenes_are_foretold_within_a_factor_of_two() {
    for (name, _) in Scene::shipped() {
        let (prediction, record) = both(&shipped(name));
        assert_near(prediction.steps, record.counters.steps as f64, 2.0, &format!("steps of {name}"));
        let most = record.steps.nodes.iter().copied().max().expect("a step");
        assert_near(prediction.most_nodes as f64, f64::from(most), 1.5, &format!("nodes of {name}"));
        assert_eq!(prediction.nodes, record.steps.nodes[0] as usize, "{name}");
    }
}

#[test]
fn the_end_of_a_run_is_foretold() {
    let (prediction, record) = both(&shipped("three_fold"));
    assert_eq!(prediction.trial.stop_reason, Some(StopReason::Equilibrium));
    assert_eq!(record.stop_reason, StopReason::Equilibrium);
    // The rest is seen at the end of a step, and steps are long there.
    assert_near(prediction.trial.time, record.frames.last().expect("a frame").time, 2.0, "time of the rest");

    // A circle that its tension shrinks to a point.
    let tension = [("energy.length.tension", "1.0"), ("time.end", "10.0")];
    let tension = tension.map(|(key, value)| (key.into(), value.into()));
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").expect("shipped");
    let mut scene = Scene::parse_with(text, "circle", &tension).expect("valid");
    scene.energy.bending = None;
    let trial = predict(&scene).expect("an initial state").trial;
    assert!(matches!(trial.stop_reason, Some(StopReason::Failed(_))), "{trial:?}");
    assert!((trial.time - 0.5).abs() < 0.02, "{trial:?}");
}

/// The steps of a trial are others than those that `time.max_steps` counts.
#[test]
fn a_trial_knows_no_most_steps() {
    let mut scene = shipped("three_fold");
    scene.time.max_steps = Some(20);
    let prediction = predict(&scene).expect("an initial state");
    assert!(
        prediction.steps > 100.0 && prediction.trial.stop_reason == Some(StopReason::Equilibrium),
        "{prediction:?}"
    );
}

#[test]
fn a_trial_does_without_the_frames_that_the_scene_asks_for() {
    let mut scene = shipped("three_fold");
    let few = predict(&scene).expect("an initial state");
    scene.output.frames = Frames::Spaced { frames: 100_000, spacing: Spacing::Linear };
    scene.accuracy.nodes = Nodes::Count(512);
    let many = predict(&scene).expect("an initial state");
    assert_near(many.steps, few.steps, 1.2, "steps");
    assert!(many.memory_bytes > 100.0 * few.memory_bytes && many.output_seconds > 30.0 * few.output_seconds);
    assert!(many.memory_bytes > 2.5 * many.file_bytes, "frames are held, and the file before it is written");
}

/// Of a scene with other values.
fn memory_of(name: &str, values: &[(&str, &str)]) -> Prediction {
    let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).expect("shipped");
    let values: Vec<_> = values.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
    predict(&Scene::parse_with(text, name, &values).expect("valid")).expect("an initial state")
}

#[test]
fn what_grows_with_the_square_of_the_nodes_is_foretold() {
    // The kernel of the scene reaches over the whole curve: two numbers for each pair of nodes.
    let adhesion =
        |nodes| memory_of("adhesion", &[("accuracy.nodes", nodes), ("output.frames", "2")]).memory_bytes;
    let (few, many) = (adhesion("512"), adhesion("2048"));
    assert_near(many - few, 8.0 * (2048.0 * 2048.0 - 512.0 * 512.0), 1.2, "bytes of pairs");
    let narrow = [("accuracy.nodes", "2048"), ("output.frames", "2"), ("energy.adhesion.cutoff", "0.1")];
    let narrow = memory_of("adhesion", &narrow).memory_bytes;
    assert!(narrow < few + 0.3 * (many - few), "{narrow} bytes of few pairs, {many} of all");

    let solver = |solver| {
        let values = [("accuracy.nodes", "800"), ("accuracy.linear_solver", solver), ("time.end", "1e-9")];
        memory_of("circle", &values)
    };
    let (auto, dense) = (solver("'auto'"), solver("'dense'"));
    let matrix = 8.0 * (dense.unknowns as f64).powi(2);
    assert!((dense.memory_bytes - auto.memory_bytes - matrix).abs() < 1.0, "{dense:?}");
}

#[test]
fn frames_that_become_too_many_on_more_nodes_are_foretold() {
    let changes = [
        ("accuracy.nodes", "'auto'"),
        ("energy.agents.epsilon", "0.005"),
        ("energy.agents.delta", "0.02"),
        ("output.frames", "100000"),
    ];
    let prediction = memory_of("three_fold", &changes);
    let error = prediction.check_frames().expect_err("too many on the most nodes");
    let SetupError::TooMuchOutput { frames, nodes, bytes, limit } = error else { panic!("{error}") };
    assert_eq!((frames, nodes), (100_001, prediction.most_nodes));
    assert!(bytes > limit && prediction.nodes < nodes);
    assert!(predict(&shipped("three_fold")).expect("an initial state").check_frames().is_ok());
}

#[test]
fn every_frame_and_every_field_of_it_takes_room() {
    let with = |frames: Frames, fields: Vec<OutputField>| {
        let mut scene = shipped("circle");
        scene.accuracy.nodes = Nodes::Count(256);
        (scene.output.frames, scene.output.fields) = (frames, fields);
        predict(&scene).expect("an initial state").file_bytes
    };
    let at = |times: &[f64]| Frames::At { times: times.to_vec() };
    let spaced = with(Frames::Spaced { frames: 4, spacing: Spacing::Linear }, vec![]);
    // The first and the last frame are saved in any case.
    assert_eq!(with(at(&[0.25, 0.5, 0.75]), vec![]), spaced);
    let both = vec![OutputField::NormalForce, OutputField::TangentialVelocity];
    let more = with(at(&[0.25, 0.5, 0.75]), both) - spaced;
    assert!((more - 8.0 * 5.0 * 2.0 * 256.0).abs() < 1e-6, "{more} bytes of two fields in five frames");
}

/// Chunks of frames are of equal size, the last one too: the file was up to 5.5 % larger than it was to be at most.
#[cfg(feature = "hdf5")]
#[test]
fn no_file_is_larger_than_foretold() {
    for (nodes, frames) in [(64, 201), (512, 37), (8192, 37)] {
        let mut scene = shipped("circle");
        scene.accuracy.nodes = Nodes::Count(nodes);
        scene.output.frames = Frames::Spaced { frames, spacing: Spacing::Linear };
        scene.time.end = 1e-6;
        let (prediction, record) = both(&scene);
        let size = flow_core::output::hdf5_file::to_bytes(&record).expect("a file").len() as f64;
        let foretold = prediction.file_bytes;
        println!("{nodes} nodes, {frames} frames: {size} of {foretold}");
        assert!(
            size <= foretold && size > foretold - 1e5,
            "{nodes} nodes, {frames} frames: {size}, {foretold}"
        );
    }
}
