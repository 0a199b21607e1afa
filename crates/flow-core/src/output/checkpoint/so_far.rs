//! What there is of a run: its result, or until there is one what its newest checkpoint holds.

use std::io::ErrorKind;
use std::path::Path;

use super::pair::Pair;
use crate::output::{Operation, StorageError, hdf5_file};
use crate::run::Record;

/// A run, as far as it has come.
#[derive(Debug)]
pub struct SoFar {
    /// The result, or what a run that goes on, or was stopped, had at its newest checkpoint.
    pub record: Record,
    /// Time of that checkpoint; none if it is a result.
    pub checkpoint: Option<f64>,
}

/// Reads the result file `path`; if there is none, the newest checkpoint beside it, whose run may go on meanwhile.
///
/// # Errors
/// [`StorageError`], of the result file if there are no checkpoints either.
pub fn so_far(path: &Path) -> Result<SoFar, StorageError> {
    match hdf5_file::read(path) {
        Ok(record) => Ok(SoFar { record, checkpoint: None }),
        Err(error) if is_missing(&error) => match Pair::beside(path).newest()? {
            // The run may have ended in between.
            None => Ok(SoFar { record: hdf5_file::read(path)?, checkpoint: None }),
            Some(found) => {
                let mut simulation = found.checkpoint.simulation(&found.path)?;
                Ok(SoFar { record: simulation.record(), checkpoint: Some(simulation.time()) })
            }
        },
        Err(error) => Err(error),
    }
}

fn is_missing(error: &StorageError) -> bool {
    matches!(error, StorageError::System { operation: Operation::Read, reason, .. } if reason.kind() == ErrorKind::NotFound)
}
