//! Why a file could not be written or read: each message names the file, the operation, the reason, a remedy.

use std::error::Error;
use std::fmt;
use std::io::{self, ErrorKind};
use std::mem::discriminant;
use std::path::{Path, PathBuf};

/// What was being done to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Making the temporary file beside the target.
    Create,
    /// Writing the bytes.
    Write,
    /// Handing the bytes to the disk (fsync).
    Sync,
    /// Giving the file its name.
    Rename,
    /// Reading the file.
    Read,
    /// Removing the file.
    Remove,
}

impl fmt::Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Create => "create a file beside it",
            Self::Write => "write",
            Self::Sync => "hand the bytes to the disk",
            Self::Rename => "give the finished file its name",
            Self::Read => "read",
            Self::Remove => "remove",
        })
    }
}

/// Why a file could not be written or read. A failed write leaves the target as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum StorageError {
    /// The target exists and may not be replaced.
    #[error("{}: already exists; choose another name, or replace it (--replace, replace=True)", .path.display())]
    Exists { path: PathBuf },
    /// The target is write-protected: replacing it would undo a decision of its owner.
    #[error("{}: is write-protected; choose another name, or make it writable first", .path.display())]
    Protected { path: PathBuf },
    /// The path names a folder, a device or a pipe.
    #[error("{}: is not a plain file; give the name of a file", .path.display())]
    NotAFile { path: PathBuf },
    /// The name is no text: the HDF5 library cannot open it.
    #[error("{}: its name, or that of a folder on the way to it, is not UTF-8, which HDF5 cannot open; rename it, or give its \
             name alone from within its folder", .path.display())]
    NotUtf8 { path: PathBuf },
    /// The folder of the target does not exist.
    #[error("{}: the folder {} does not exist; create it first", .path.display(), .folder.display())]
    FolderMissing { path: PathBuf, folder: PathBuf },
    /// The operating system refused.
    #[error("{}: cannot {operation}: {reason}; {}", .path.display(), remedy(*.operation, .reason))]
    System { path: PathBuf, operation: Operation, reason: io::Error },
    /// Frame or step data do not fit together, so the file could not be rectangular.
    #[error(
        "{item} holds {found} values in frame or column {index}, expected {expected}: a bug, please report it"
    )]
    Ragged { item: &'static str, index: usize, found: usize, expected: usize },
    /// The HDF5 library failed to build the file in memory; the disk was not touched.
    #[error("building {item} in memory failed; free some memory, or ask for fewer frames")]
    Build { item: String, source: Box<dyn Error + Send + Sync> },
    /// The file is not HDF5 at all.
    #[error("{}: is not an HDF5 file; give a result file of Curveflow", .path.display())]
    NotHdf5 { path: PathBuf },
    /// The file is HDF5, but was not written by this program.
    #[error("{}: is an HDF5 file, but {}; give a result file of Curveflow", .path.display(), origin(.found.as_deref(), expected))]
    Foreign { path: PathBuf, found: Option<String>, expected: &'static str },
    /// The file is no checkpoint.
    #[error("{}: is not a checkpoint of this version of Curveflow; use the version that wrote it, or start the run anew (`run \
             --replace`)", .path.display())]
    NotACheckpoint { path: PathBuf },
    /// The checkpoint is truncated, or a checksum does not fit.
    #[error("{}: is truncated or damaged at `{item}`; restore it from a copy, or start the run anew (`run --replace`)",
            .path.display())]
    DamagedCheckpoint { path: PathBuf, item: String, source: Box<dyn Error + Send + Sync> },
    /// The checkpoint is whole, but its scene or its state cannot be used.
    #[error("{}: {reason}", .path.display())]
    ForeignCheckpoint { path: PathBuf, reason: String },
    /// A run was stopped before its end, and is to be thrown away.
    #[error("{}: a run to this file was stopped before its end, at t = {time:.6e} (step {steps}); go on with `resume`, \
             choose another name, or replace it (--replace, replace=True)", .path.display())]
    Unfinished { path: PathBuf, steps: u64, time: f64 },
    /// Something else has come to where a run that goes on would write its result.
    #[error("{}: is not a result of the run whose checkpoints lie beside it; move it away, then go on with `resume`",
            .path.display())]
    InTheWay { path: PathBuf },
    /// There is nothing to go on from.
    #[error("{}: has no checkpoint to go on from; checkpoints lie beside the result file, give its name as in `run -o`",
            .path.display())]
    NoCheckpoint { path: PathBuf },
    /// Another process writes to the file.
    #[error("{}: another run writes to this file; wait for it, or choose another name", .path.display())]
    Busy { path: PathBuf },
    /// The file is truncated or its content does not pass a checksum.
    #[error("{}: is truncated or damaged at {item}; restore it from a copy, or run the scene again",
            .path.display())]
    Damaged { path: PathBuf, item: String, source: Box<dyn Error + Send + Sync> },
}

impl StorageError {
    /// `true` if a file to be read is not one of ours, or no longer readable.
    #[must_use]
    pub fn is_unreadable_file(&self) -> bool {
        matches!(
            self,
            Self::NotHdf5 { .. }
                | Self::Foreign { .. }
                | Self::Damaged { .. }
                | Self::NotACheckpoint { .. }
                | Self::DamagedCheckpoint { .. }
                | Self::ForeignCheckpoint { .. }
                | Self::NoCheckpoint { .. }
        )
    }

    /// `true` if there was no memory for what is in the file.
    #[must_use]
    pub fn is_for_want_of_memory(&self) -> bool {
        matches!(self, Self::System { reason, .. } if reason.kind() == ErrorKind::OutOfMemory)
    }

    /// Whether it has the same cause as `other`, perhaps at another file.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (
                Self::System { operation, reason, .. },
                Self::System { operation: other_operation, reason: other_reason, .. },
            ) => operation == other_operation && reason.kind() == other_reason.kind(),
            _ => discriminant(self) == discriminant(other),
        }
    }

    #[cold]
    pub(super) fn system(path: &Path, operation: Operation, reason: io::Error) -> Self {
        Self::System { path: path.to_path_buf(), operation, reason }
    }
}

/// Whose file it is instead.
fn origin(found: Option<&str>, expected: &str) -> String {
    match found {
        Some(found) => format!("its attribute Conventions is {found:?}, not {expected:?}"),
        None => format!("it has no attribute Conventions, which is {expected:?} in a result"),
    }
}

/// One thing to try.
fn remedy(operation: Operation, reason: &io::Error) -> &'static str {
    match reason.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "free some space, or choose another disk",
        ErrorKind::FileTooLarge => "raise the file size limit (ulimit -f), or ask for fewer frames",
        ErrorKind::OutOfMemory => "free some memory, or raise its limit (ulimit -v, that of the job)",
        ErrorKind::PermissionDenied if operation == Operation::Read => "ask its owner for read access",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "choose a folder you may write to",
        ErrorKind::NotFound if operation == Operation::Read => "check the name",
        ErrorKind::IsADirectory => "give the name of a file",
        ErrorKind::InvalidFilename => "choose a shorter name",
        _ if operation == Operation::Read => "check the disk, or copy the file to another one",
        _ => "choose another folder",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_alike_if_their_causes_are() {
        let system = |path: &str, operation, kind| {
            StorageError::system(Path::new(path), operation, io::Error::from(kind))
        };
        let full = system("a", Operation::Write, ErrorKind::StorageFull);
        assert!(full.is_like(&system("b", Operation::Write, ErrorKind::StorageFull)));
        assert!(!full.is_like(&system("a", Operation::Create, ErrorKind::StorageFull)));
        assert!(!full.is_like(&system("a", Operation::Write, ErrorKind::PermissionDenied)));
        assert!(!full.is_like(&StorageError::Protected { path: PathBuf::from("a") }));
    }
}
