//! Which results belong to the run of a checkpoint.

use std::io::ErrorKind;

use super::format::{Checkpoint, SceneTexts};
use super::identity::Identity;
use super::pair::Pair;
use crate::output::{StorageError, hdf5_file};
use crate::run::{Record, Scene};

/// Whether `record` is of the run, as far as it had come, or of another one of the same scene.
pub(super) fn is_of_scene(record: &Record, scene: &SceneTexts) -> bool {
    let read = |text: &str| Scene::parse(text, "the scene of a run").ok();
    record.resolved_scene == scene.resolved
        || read(&record.resolved_scene)
            .zip(read(&scene.resolved))
            // Of the steps that it may take, one that goes on may have got more.
            .is_some_and(|(one, other)| one.is_but_for_steps(&other))
}

/// Fails if the file that lies where the run of `checkpoint` is to write its result is neither of the same scene nor the one that the
/// run was told to replace when it began: nobody has asked to replace it.
///
/// # Errors
/// [`StorageError::InTheWay`], or [`StorageError::System`] if it cannot be read.
pub fn check_way(pair: &Pair, checkpoint: &Checkpoint) -> Result<(), StorageError> {
    let path = pair.result();
    let is_known = checkpoint.replaces.is_some() && Identity::of(pair.target()).ok() == checkpoint.replaces;
    if is_known {
        return Ok(());
    }
    match hdf5_file::read(path) {
        Ok(record) if is_of_scene(&record, &checkpoint.scene) => Ok(()),
        Err(StorageError::System { reason, .. }) if reason.kind() == ErrorKind::NotFound => Ok(()),
        Err(
            error @ (StorageError::System { .. }
            | StorageError::NotAFile { .. }
            | StorageError::NotUtf8 { .. }),
        ) => Err(error),
        _ => Err(StorageError::InTheWay { path: path.to_path_buf() }),
    }
}
