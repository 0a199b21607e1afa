//! Two checkpoint files beside a result file: one is written while the other stays whole.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::encoding::Content;
use super::file::read;
use super::format::Checkpoint;
use super::identity::Identity;
use crate::output::links::{beside, followed};
use crate::output::{Operation, StorageError, atomic_file};
use crate::run::{Memory, Record, Simulation};

const SUFFIXES: [&str; 2] = [".checkpoint-a", ".checkpoint-b"];

/// The two files of one result file.
#[derive(Clone, Debug)]
pub struct Pair {
    result: PathBuf,
    /// The file that `result` led to at the start.
    target: PathBuf,
    paths: [PathBuf; 2],
    /// Which one is written next.
    next: usize,
    /// Whether the files, if any, are those of a run that this one replaces.
    superseded: bool,
    /// The result that the run may replace.
    replaces: Option<Identity>,
}

/// The newest checkpoint that is whole.
#[derive(Debug)]
pub struct Found {
    /// Its content.
    pub checkpoint: Checkpoint,
    /// Its file.
    pub path: PathBuf,
    /// What is wrong with the other file.
    pub damaged: Option<StorageError>,
}

impl Pair {
    /// The files for the result file `result`, beside the file that it leads to if it is a link; nothing is written.
    #[must_use]
    pub fn beside(result: &Path) -> Self {
        let target = followed(result);
        let (result, paths) = (result.to_path_buf(), files(&target));
        Self { result, paths, target, next: 0, superseded: false, replaces: None }
    }

    /// The newest checkpoint, if there is any; the next one is then written to the other file.
    ///
    /// # Errors
    /// [`StorageError`] if files are there and none of them is whole.
    pub fn newest(&mut self) -> Result<Option<Found>, StorageError> {
        let mut newest: Option<(usize, Checkpoint)> = None;
        let mut damaged = None;
        for (index, path) in self.paths.iter().enumerate() {
            match read(path) {
                Err(StorageError::System { reason, .. }) if reason.kind() == ErrorKind::NotFound => {}
                Ok(checkpoint) => {
                    let steps = checkpoint.memory.steps();
                    if newest.as_ref().is_none_or(|(_, other)| other.memory.steps() < steps) {
                        newest = Some((index, checkpoint));
                    }
                }
                // It may be the newer one, and whole.
                Err(error) if error.is_for_want_of_memory() => return Err(error),
                Err(error) => damaged = Some(error),
            }
        }
        match (newest, damaged) {
            (Some((index, checkpoint)), damaged) => {
                self.next = 1 - index;
                self.replaces = checkpoint.replaces;
                Ok(Some(Found { checkpoint, path: self.paths[index].clone(), damaged }))
            }
            (None, Some(error)) => Err(error),
            (None, None) => Ok(None),
        }
    }

    /// Fails if a run was stopped here, unless it may be replaced: then its checkpoints go as soon as there is one of the new run.
    ///
    /// # Errors
    /// [`StorageError::Unfinished`], or what [`Pair::newest`] says.
    pub fn start_anew(&mut self, replace: bool) -> Result<(), StorageError> {
        if replace {
            self.superseded = true;
            // The newest is the one that the first checkpoint of the new run replaces, in one step.
            if matches!(self.newest(), Ok(Some(_))) {
                self.next = 1 - self.next;
            }
            // Whoever goes on with the new run may replace this file too, and no other one.
            self.replaces = Identity::of(&self.target).ok();
            return Ok(());
        }
        match self.newest()? {
            None => Ok(()),
            Some(Found { checkpoint, .. }) => Err(StorageError::Unfinished {
                path: self.result.clone(),
                steps: checkpoint.memory.steps(),
                time: checkpoint.memory.time(),
            }),
        }
    }

    /// Saves `simulation`; the checkpoint before this one stays, if it is of the same run.
    ///
    /// # Errors
    /// [`StorageError`]; the newest of the files is then as it was.
    pub fn write(&mut self, simulation: &Simulation) -> Result<(), StorageError> {
        let memory = simulation.memory();
        self.write_content(&Content::of(simulation, &memory, self.replaces))
    }

    /// Saves the run that is over and has become `record`.
    ///
    /// # Errors
    /// As for [`Pair::write`].
    pub(super) fn write_ended(&mut self, record: &Record, memory: &Memory) -> Result<(), StorageError> {
        self.write_content(&Content::of_ended(record, memory, self.replaces))
    }

    /// Writes the older of the two files.
    fn write_content(&mut self, content: &Content<'_>) -> Result<(), StorageError> {
        if self.superseded {
            // Of two files the one with more steps counts: none of the run before may outlive the first of this one.
            remove(&self.paths[1 - self.next])?;
        }
        atomic_file::write_with(&self.paths[self.next], true, |file| content.write_to(file))?;
        self.next = 1 - self.next;
        self.superseded = false;
        Ok(())
    }

    /// Removes both files: the run is done.
    ///
    /// # Errors
    /// [`StorageError`] if one is there and cannot be removed.
    pub fn remove(&self) -> Result<(), StorageError> {
        self.paths.iter().try_for_each(|path| remove(path))
    }

    /// Whether the files that are there, if any, are those of a run that this one replaces.
    #[must_use]
    pub fn is_of_another_run(&self) -> bool {
        self.superseded
    }

    /// Whether a checkpoint of the run itself is there.
    #[must_use]
    pub fn holds_own(&self) -> bool {
        !self.superseded && matches!(self.clone().newest(), Ok(Some(_)))
    }

    /// The file that the result is to be written to: where its name led when the lock was taken, also if that is a link to another
    /// file by now.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// The result file, as it was named.
    #[must_use]
    pub fn result(&self) -> &Path {
        &self.result
    }
}

/// Names of the checkpoints of `result`.
pub(super) fn files(result: &Path) -> [PathBuf; 2] {
    SUFFIXES.map(|suffix| beside(result, suffix))
}

/// Removes a file, if it is there.
fn remove(path: &Path) -> Result<(), StorageError> {
    match fs::remove_file(path) {
        Err(reason) if reason.kind() != ErrorKind::NotFound => {
            Err(StorageError::system(path, Operation::Remove, reason))
        }
        _ => Ok(()),
    }
}
