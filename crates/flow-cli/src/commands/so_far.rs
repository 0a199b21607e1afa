//! Runs that are looked at, also before they are over.

use std::path::Path;

use flow_core::output::StorageError;
use flow_core::output::checkpoint::{Lock, SoFar, so_far};
use flow_core::run::{Record, StopReason};

use crate::print;

/// The result at `path`, or what its run has so far, which is said.
pub fn run_so_far(path: &Path) -> Result<Record, StorageError> {
    let found = so_far(path);
    let shows_a_checkpoint = matches!(&found, Ok(found) if found.checkpoint.or(found.successor).is_some());
    if !shows_a_checkpoint && Lock::is_held(path) {
        let written = found.as_ref().map_or("nothing yet".to_owned(), |found| written(&found.record));
        print::talk(&format!("note: a run to {} goes on, which has written {written}", path.display()));
    }
    let SoFar { record, checkpoint, successor } = found?;
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

/// What a run has written that goes on beside the result `record`, of itself if that is where it was stopped before.
fn written(record: &Record) -> String {
    match (&record.stop_reason, record.frames.last()) {
        (StopReason::Interrupted | StopReason::Failed(_), Some(last)) => {
            format!(
                "nothing since it began; this is how far it, or one before it, had come, to t = {:.6e}",
                last.time
            )
        }
        _ => "nothing yet; this is the result that is there".to_owned(),
    }
}
