//! What there is of a run: its result, or until there is one what its newest checkpoint holds.

use std::io::ErrorKind;
use std::path::Path;

use super::belonging::is_of_scene;
use super::format::Checkpoint;
use super::pair::{Found, Pair};
use crate::output::memory::check_room;
use crate::output::{Operation, StorageError, hdf5_file};
use crate::run::{Frame, Record, StopReason};

/// A run, as far as it has come.
#[derive(Debug)]
pub struct SoFar {
    /// The result, or what a run that goes on, or was stopped, had at its newest checkpoint.
    pub record: Record,
    /// Time of that checkpoint; none if it is a result.
    pub checkpoint: Option<f64>,
    /// Time of the newest checkpoint of another run, which is to replace this result and is not over.
    pub successor: Option<f64>,
}

/// Reads the result file `path`; if there is none, or if its run has come further since it was stopped, the newest checkpoint beside it,
/// whose run may go on meanwhile.
///
/// # Errors
/// [`StorageError`], of the result file if there are no checkpoints either.
pub fn so_far(path: &Path) -> Result<SoFar, StorageError> {
    match hdf5_file::read(path) {
        Ok(record) => Ok(beside(record, path)),
        Err(error) if is_missing(&error) => match Pair::beside(path).newest()? {
            // The run may have ended in between.
            None => Ok(SoFar { record: hdf5_file::read(path)?, checkpoint: None, successor: None }),
            Some(found) => at(found),
        },
        Err(error) => Err(error),
    }
}

fn at(found: Found) -> Result<SoFar, StorageError> {
    let failed = |reason| StorageError::system(&found.path, Operation::Read, reason);
    check_room(growth_on_common_nodes(&found.checkpoint.frames)).map_err(failed)?;
    let simulation = found.checkpoint.simulation(&found.path)?;
    let time = simulation.time();
    Ok(SoFar { record: simulation.into_record(), checkpoint: Some(time), successor: None })
}

/// What `frames` take more once they are all on the largest number of nodes among them.
fn growth_on_common_nodes(frames: &[Frame]) -> u64 {
    let bytes = |frame: &Frame| frame.nodes() * (frame.nodal_fields().count() + 2) * size_of::<f64>();
    let most = frames.iter().map(bytes).max().unwrap_or_default();
    frames.iter().map(|frame| (most - bytes(frame)) as u64).sum()
}

/// The result `record` in the file `path`, or more of its run. Checkpoints that are no good do not matter to a result.
fn beside(record: Record, path: &Path) -> SoFar {
    let of = |record, successor| SoFar { record, checkpoint: None, successor };
    let Ok(Some(found)) = Pair::beside(path).newest() else { return of(record, None) };
    let Checkpoint { scene, memory, replaces, .. } = &found.checkpoint;
    let time = memory.time();
    let is_part = matches!(record.stop_reason, StopReason::Interrupted | StopReason::Failed(_));
    match (is_of_scene(&record, scene), is_part) {
        (true, true) if memory.steps() > record.counters.steps => at(found).unwrap_or(of(record, None)),
        (true, true) => of(record, None),
        // Without one that it may replace, it is the run that has just written this result.
        (true, false) => of(record, replaces.is_some().then_some(time)),
        (false, _) => of(record, Some(time)),
    }
}

fn is_missing(error: &StorageError) -> bool {
    matches!(error, StorageError::System { operation: Operation::Read, reason, .. } if reason.kind() == ErrorKind::NotFound)
}
