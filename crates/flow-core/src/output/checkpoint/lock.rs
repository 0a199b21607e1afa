//! One run at a time for each result file.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use super::pair::files;
use crate::output::links::{beside, followed};
use crate::output::temporary::remove_left;
use crate::output::{Operation, StorageError};

/// How often, and how long apart, a lock that is taken is asked for before it counts as that of a run: whoever asks whether a run goes on
/// holds it for an instant.
const ATTEMPTS: u32 = 20;
const PAUSE: Duration = Duration::from_millis(5);

/// Held while a run writes to a result file; given back when dropped, and by the system if the process dies.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    _file: File,
    missing: Option<io::Error>,
}

impl Lock {
    /// Takes the lock of the result file `result`; all links to one file have the same. What killed processes have left there half
    /// written is removed.
    ///
    /// # Errors
    /// [`StorageError::Busy`] if another process has it.
    pub fn of(result: &Path) -> Result<Self, StorageError> {
        let lock = Self::taken_by(File::try_lock, result)?;
        if lock.missing.is_none() {
            [followed(result)].iter().chain(&files(result)).for_each(|path| remove_left(path));
        }
        Ok(lock)
    }

    /// Whether a run has the lock of the result file `result`, as far as can be told without making one. There is no way to ask without
    /// taking it for an instant, shared by all who ask; a run that begins meanwhile waits for that.
    #[must_use]
    pub fn is_held(result: &Path) -> bool {
        let Ok(file) = File::open(beside(result, ".lock")) else { return false };
        matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock))
    }

    /// Why the file system, which has no locks, cannot tell others that a run writes here; none if it can.
    #[must_use]
    pub fn missing(&self) -> Option<&io::Error> {
        self.missing.as_ref()
    }

    fn taken_by(
        try_lock: impl Fn(&File) -> Result<(), TryLockError>,
        result: &Path,
    ) -> Result<Self, StorageError> {
        let path = beside(result, ".lock");
        let mut refusals = 0;
        loop {
            let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path);
            let file = file.map_err(|reason| StorageError::system(result, Operation::Create, reason))?;
            let missing = match try_lock(&file) {
                // The one before us may have removed the file that we opened.
                Ok(()) if !is_named(&file, &path) => continue,
                Ok(()) => None,
                Err(TryLockError::WouldBlock) if refusals < ATTEMPTS => {
                    refusals += 1;
                    sleep(PAUSE);
                    continue;
                }
                Err(TryLockError::WouldBlock) => {
                    return Err(StorageError::Busy { path: result.to_path_buf() });
                }
                Err(TryLockError::Error(reason)) if reason.kind() == ErrorKind::Interrupted => continue,
                // Some network file systems have no locks, or none at the moment, and say so in several ways.
                Err(TryLockError::Error(reason)) => Some(reason),
            };
            return Ok(Self { path, _file: file, missing });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_there_are_no_locks_a_run_goes_on_and_can_tell_so() {
        let result = std::env::temp_dir().join(format!("curveflow-lock-{}.h5", std::process::id()));
        let none = |_: &File| Err(TryLockError::Error(ErrorKind::Unsupported.into()));
        let lock = Lock::taken_by(none, &result).unwrap();
        assert_eq!(lock.missing().unwrap().kind(), ErrorKind::Unsupported);
        drop(lock);
        let lock = Lock::of(&result).unwrap();
        assert!(lock.missing().is_none());
        assert!(matches!(Lock::of(&result), Err(StorageError::Busy { .. })));
        assert!(Lock::is_held(&result));
        drop(lock);
        assert!(!Lock::is_held(&result));
        assert!(!beside(&result, ".lock").exists());
    }

    #[test]
    fn who_only_asks_does_not_keep_a_run_from_beginning() {
        let result = std::env::temp_dir().join(format!("curveflow-asked-{}.h5", std::process::id()));
        let asking = File::create(beside(&result, ".lock")).unwrap();
        asking.lock_shared().unwrap();
        assert!(!Lock::is_held(&result), "of those who ask none is a run");
        std::thread::scope(|scope| {
            scope.spawn(|| {
                sleep(2 * PAUSE);
                drop(asking);
            });
            assert!(Lock::of(&result).unwrap().missing().is_none());
        });
    }
}
