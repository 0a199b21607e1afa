//! Runs that are looked at, also before they are over.

use std::path::Path;

use flow_core::output::StorageError;
use flow_core::output::checkpoint::{SoFar, so_far};
use flow_core::run::Record;

use crate::print;

/// The result at `path`, or what its run has so far, which is said.
pub fn run_so_far(path: &Path) -> Result<Record, StorageError> {
    let SoFar { record, checkpoint, successor } = so_far(path)?;
    if let Some(time) = checkpoint {
        print::talk(&format!(
            "note: the run to {} is not over; this is its newest checkpoint, at t = {time:.6e} (if nobody runs it any more, \
             `curveflow resume` goes on)",
            path.display()
        ));
    }
    if let Some(time) = successor {
        print::talk(&format!(
            "note: a run that is to replace {} is not over, its newest checkpoint is at t = {time:.6e}; this is the result that is there",
            path.display()
        ));
    }
    Ok(record)
}
