//! One checkpoint in a file of any name.

use std::fs;
use std::path::Path;

use super::encoding::Content;
use super::format::{Checkpoint, MAGIC, decode};
use crate::output::memory::check_room;
use crate::output::signature::begins_with;
use crate::output::{Operation, StorageError, atomic_file};
use crate::run::Simulation;

/// The checkpoint in a file.
///
/// # Errors
/// [`StorageError`] if it cannot be read, is no checkpoint or is damaged.
pub fn read(path: &Path) -> Result<Checkpoint, StorageError> {
    let failed = |reason| StorageError::system(path, Operation::Read, reason);
    // Asked before opening: a pipe would wait for its other end, a device need not end at all.
    if !fs::metadata(path).map_err(failed)?.is_file() {
        return Err(StorageError::NotAFile { path: path.to_path_buf() });
    }
    let bytes = fs::read(path).map_err(failed)?;
    check_room(bytes.len() as u64).map_err(failed)?; // what is decoded takes about as much
    decode(&bytes, path)
}

/// Saves `simulation` to `path`. Another checkpoint there, of any version, is replaced; any other file only if `replace`.
///
/// # Errors
/// [`StorageError`]; the file is then as it was.
pub fn write(simulation: &Simulation, path: &Path, replace: bool) -> Result<(), StorageError> {
    let memory = simulation.memory();
    let content = Content::of(simulation, &memory, None);
    atomic_file::write_with(path, replace || is_checkpoint(path), |file| content.write_to(file))
}

fn is_checkpoint(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| found.is_file()) && begins_with(path, MAGIC).unwrap_or(false)
}
