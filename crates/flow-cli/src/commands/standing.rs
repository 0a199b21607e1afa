//! What a command finds at its result file: whether another run writes there, and how far one has come.

use std::path::Path;

use flow_core::output::checkpoint::{Found, Lock, Pair};
use flow_core::output::{StorageError, hdf5_file};
use flow_core::run::Record;

use crate::error::CliError;
use crate::print;

/// How far a run to a result file has come.
pub enum Standing {
    /// There is none.
    Nothing(Lock),
    /// It was stopped, and can go on.
    Stopped(Box<Found>, Lock),
    /// There is a result and no checkpoint: it came to its end, or its checkpoints were removed.
    Over(Box<Record>),
}

impl Standing {
    /// That of the result file of `pair`; nobody else may run to it any more, unless it is over.
    pub fn of(pair: &mut Pair) -> Result<Self, CliError> {
        let lock = lock(pair.result());
        match (pair.newest()?, lock) {
            // A run that is done may lie where nothing can be written, not even a lock.
            (None, Ok(_) | Err(StorageError::System { .. })) if pair.result().exists() => {
                Ok(Self::Over(Box::new(hdf5_file::read(pair.result())?)))
            }
            (_, Err(error)) => Err(error.into()),
            (Some(found), Ok(lock)) => Ok(Self::Stopped(Box::new(found), lock)),
            (None, Ok(lock)) => Ok(Self::Nothing(lock)),
        }
    }
}

/// Takes the lock of a result file; says so where there are no locks.
pub fn lock(result: &Path) -> Result<Lock, StorageError> {
    let lock = Lock::of(result)?;
    if let Some(reason) = lock.missing() {
        print::talk(&format!(
            "warning: {}: its file system has no locks ({reason}), and a second run to this file would not be noticed: mind \
             to start only one",
            result.display()
        ));
    }
    Ok(lock)
}
