//! One run at a time for each result file.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use crate::output::links::beside;
use crate::output::{Operation, StorageError};

/// Held while a run writes to a result file; given back when dropped, and by the system if the process dies.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock of the result file `result`; all links to one file have the same.
    ///
    /// # Errors
    /// [`StorageError::Busy`] if another process has it.
    pub fn of(result: &Path) -> Result<Self, StorageError> {
        let path = beside(result, ".lock");
        loop {
            let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path);
            let file = file.map_err(|reason| StorageError::system(result, Operation::Create, reason))?;
            match file.try_lock() {
                // The one before us may have removed the file that we opened.
                Ok(()) if is_named(&file, &path) => return Ok(Self { path, _file: file }),
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(StorageError::Busy { path: result.to_path_buf() });
                }
                Err(TryLockError::Error(reason)) => {
                    return Err(StorageError::system(result, Operation::Create, reason));
                }
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while still held; if that fails, an empty file stays, which locks nothing.
        let _ = fs::remove_file(&self.path);
    }
}

/// Whether `path` is a name of the open `file`.
#[cfg(unix)]
fn is_named(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    let open = file.metadata().map(identity);
    let named = fs::metadata(path).map(identity);
    matches!((open, named), (Ok(open), Ok(named)) if open == named)
}

/// Elsewhere an open file cannot be removed.
#[cfg(not(unix))]
fn is_named(_: &File, _: &Path) -> bool {
    true
}
