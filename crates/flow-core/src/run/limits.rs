//! What a run may ask for: more is refused before the memory is asked for.

use super::chunks::chunk_rows;
use super::scene::{Frames, LinearSolver, Scene};
use super::setup_error::SetupError;
use crate::geometry::Layout;

/// Largest memory of all frames, in bytes.
pub(super) const MOST_FRAME_BYTES: f64 = 16e9;
/// Most rows of a dense matrix: 128 MB, and minutes for each factorisation.
const MOST_DENSE: usize = 4096;
/// Curvature, metric, velocity and two coordinates.
const FIELDS: usize = 5;
const COORDINATES: usize = 2;
/// Bytes of a file for its names and attributes, for the numbers of a frame and for a step of its log: no shipped scene takes more.
const FILE_BYTES: f64 = 48e3;
const NUMBERS_BYTES: f64 = 400.0;
const STEP_BYTES: f64 = 64.0;

/// Bytes of `frames` frames on `layout`, with `extra` fields besides those that every frame holds.
pub(super) fn frame_bytes(frames: usize, layout: Layout, extra: usize) -> f64 {
    8.0 * frames as f64 * (layout.nodes() * (FIELDS + layout.densities() + extra)) as f64
}

/// Bytes of the result file of `scene` on `layout`, with `extra` fields besides those that every frame holds, after `steps` steps.
pub(super) fn file_bytes(scene: &Scene, layout: Layout, extra: usize, steps: f64) -> f64 {
    let (frames, nodes) = (frames(scene), layout.nodes());
    let stored = |row: usize| frames.next_multiple_of(chunk_rows(frames, row).max(1)) * row;
    let of_nodes = FIELDS - COORDINATES + layout.densities() + extra;
    let values = of_nodes * stored(nodes) + stored(COORDINATES * nodes) + nodes;
    8.0 * values as f64 + NUMBERS_BYTES * frames as f64 + STEP_BYTES * steps + FILE_BYTES
}

/// Bytes of the matrix of a dense solver on `layout`; none for the others.
pub(super) fn matrix_bytes(scene: &Scene, layout: Layout) -> f64 {
    let dense = scene.accuracy.linear_solver == LinearSolver::Dense;
    if dense { 8.0 * (layout.len() as f64).powi(2) } else { 0.0 }
}

/// Checks what `scene` asks for on the nodes of `layout`.
///
/// # Errors
/// [`SetupError::TooMuchOutput`] or [`SetupError::TooLargeForDense`].
pub(super) fn check(scene: &Scene, layout: Layout, extra: usize) -> Result<(), SetupError> {
    check_solver(scene, layout)?;
    check_frames(frames(scene), layout, extra, MOST_FRAME_BYTES)
}

/// Checks that the solver of `scene` has room for the unknowns of `layout`.
///
/// # Errors
/// [`SetupError::TooLargeForDense`].
pub(super) fn check_solver(scene: &Scene, layout: Layout) -> Result<(), SetupError> {
    let unknowns = layout.len();
    if scene.accuracy.linear_solver == LinearSolver::Dense && unknowns > MOST_DENSE {
        return Err(SetupError::TooLargeForDense { unknowns, most: MOST_DENSE });
    }
    Ok(())
}

/// Checks that `frames` frames on `layout` take no more than `limit` bytes.
///
/// # Errors
/// [`SetupError::TooMuchOutput`].
pub(super) fn check_frames(
    frames: usize,
    layout: Layout,
    extra: usize,
    limit: f64,
) -> Result<(), SetupError> {
    check_frame_bytes(frames, layout.nodes(), frame_bytes(frames, layout, extra), limit)
}

/// The same for frames on `nodes` nodes that take `bytes`.
///
/// # Errors
/// [`SetupError::TooMuchOutput`].
pub(super) fn check_frame_bytes(
    frames: usize,
    nodes: usize,
    bytes: f64,
    limit: f64,
) -> Result<(), SetupError> {
    if bytes > limit {
        return Err(SetupError::TooMuchOutput { frames, nodes, bytes, limit });
    }
    Ok(())
}

/// Frames that are saved at most, the first and the last included.
pub(super) fn frames(scene: &Scene) -> usize {
    match &scene.output.frames {
        Frames::Spaced { frames, .. } => frames + 1,
        Frames::At { times } => times.len() + 2,
    }
}
