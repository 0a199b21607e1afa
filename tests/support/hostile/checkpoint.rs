//! The bytes of a checkpoint.

use std::path::Path;

use flow_core::output::checkpoint::{decode, encode};
use flow_core::run::scene::Nodes;
use flow_core::run::{Quiet, Scene, Simulation};

use super::check_message;

/// Bytes before the first section: magic and version.
const HEAD: usize = 12;
/// Bytes of a section before its content: length and checksum.
const SECTION_HEAD: usize = 12;
/// Checkpoints of larger scenes are read, and not gone on with.
const MOST_NODES: usize = 64;
const STEPS: usize = 3;

/// Small runs, one for each kind of memory: a plain one, one with densities, one in another gauge.
const SCENES: [&str; 3] = [
    "curve = { shape = 'circle', radius = 1 }
    time.end = 1
    energy.bending.rigidity = 1
    accuracy = { nodes = 12, tolerance = 1e-2 }
    output.frames = 3",
    "curve = { shape = 'ellipse', semi_axes = [1.2, 1] }
    time.end = 1
    energy = { bending = { rigidity = 1, preferred_curvature = 'rho' }, length.tension = 1 }
    density = [{ name = 'protein', initial = '0.5 + 0.1*cos(2*pi*s)', mobility = 'diffusion' }]
    flow.switch = [{ time = 1e-6, gauge = 'scaled-arc-length' }]
    accuracy = { nodes = 16, tolerance = 1e-2, linear_solver = 'banded' }
    output = { frames = 5, spacing = 'log' }",
    "curve = { shape = 'ellipse', semi_axes = [1.2, 1] }
    time.end = 1
    energy.bending.rigidity = 1
    flow = { gauge = 'co-moving', normal_mobility = 'area-preserving', stop_on_contact = true }
    accuracy = { nodes = 16, tolerance = 1e-2 }
    output.frames = 3",
];

/// Checkpoints of this version, of small runs: what a fuzzer starts from.
///
/// # Panics
/// If the runs do not start.
#[must_use]
pub fn checkpoints() -> Vec<Vec<u8>> {
    let encoded = |text: &&str| {
        let scene = Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}"));
        let mut simulation = Simulation::new(&scene).unwrap_or_else(|error| panic!("{error}"));
        for _ in 0..2 * STEPS {
            simulation.step(&mut Quiet);
        }
        encode(&simulation)
    };
    SCENES.iter().map(encoded).collect()
}

/// Reads a checkpoint as it is, and as one who can compute checksums would have it; one that is accepted goes on.
pub fn checkpoint(bytes: &[u8]) {
    go_on(bytes);
    go_on(&mended(bytes));
}

/// `bytes` with the checksums that fit them, so that changes get past those.
#[must_use]
pub fn mended(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut start = HEAD;
    while let Some((head, content)) =
        bytes.get_mut(start..).and_then(|rest| rest.split_at_mut_checked(SECTION_HEAD))
    {
        let length: [u8; 8] = std::array::from_fn(|k| head[k]);
        let Ok(length) = usize::try_from(u64::from_le_bytes(length)) else { break };
        let Some(content) = content.get(..length) else { break };
        head[8..].copy_from_slice(&crc32fast::hash(content).to_le_bytes());
        start += SECTION_HEAD + length;
    }
    bytes
}

fn go_on(bytes: &[u8]) {
    let path = Path::new("out.h5.checkpoint-a");
    let checkpoint = match decode(bytes, path) {
        Ok(checkpoint) => checkpoint,
        Err(error) => {
            assert!(error.is_unreadable_file(), "{error}");
            return check_message(&error);
        }
    };
    let scene = Scene::parse(&checkpoint.scene.resolved, "scene");
    let small = |nodes: Nodes| matches!(nodes, Nodes::Count(count) if count <= MOST_NODES);
    if scene.is_ok_and(|scene| !small(scene.accuracy.nodes)) {
        return;
    }
    match checkpoint.simulation(path) {
        Err(error) => {
            assert!(error.is_unreadable_file(), "{error}");
            check_message(&error);
        }
        Ok(mut simulation) => {
            for _ in 0..STEPS {
                simulation.step(&mut Quiet);
            }
            assert!(simulation.into_record().frames.iter().all(|frame| frame.time.is_finite()));
        }
    }
}
