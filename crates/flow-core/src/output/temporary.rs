//! Temporary files. Each is named after the file that it is to become, so that what a killed process has left is known by its name.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

const SUFFIX: &str = ".partial";
/// Longer names leave no room for the rest; their temporary files are named after the program.
const LONGEST: usize = 200;

/// A temporary file, removed when dropped unless it was renamed before.
pub(super) struct Temporary {
    pub path: PathBuf,
    pub file: File,
}

impl Temporary {
    /// One in the folder of `target`.
    pub fn beside(target: &Path) -> io::Result<Self> {
        static COUNTER: AtomicU64 = AtomicU64::new(0);
        loop {
            let mut name = prefix(target).unwrap_or_else(|| OsString::from(".curveflow-"));
            name.push(format!("{}-{}{SUFFIX}", process::id(), COUNTER.fetch_add(1, Ordering::Relaxed)));
            let path = target.with_file_name(name);
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => return Ok(Self { path, file }),
                Err(reason) if reason.kind() == ErrorKind::AlreadyExists => {}
                Err(reason) => return Err(reason),
            }
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After a rename there is nothing left to remove, and on the way out of an error no one to tell.
        let _ = fs::remove_file(&self.path);
    }
}

/// Removes what killed processes have left that were writing `target`. Nobody else may be writing it now.
pub(super) fn remove_left(target: &Path) {
    let folder = target.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let (Some(prefix), Ok(entries)) = (prefix(target), fs::read_dir(folder)) else { return };
    for entry in entries.flatten().filter(|entry| is_named_by(&prefix, &entry.file_name())) {
        let _ = fs::remove_file(entry.path()); // rubbish that cannot be removed does no harm
    }
}

/// What the names of the temporary files of `target` begin with.
fn prefix(target: &Path) -> Option<OsString> {
    let name = target.file_name().filter(|name| name.len() <= LONGEST)?;
    let mut prefix = OsString::from(".");
    prefix.push(name);
    prefix.push("-");
    Some(prefix)
}

/// Whether `name` is `prefix` and two numbers: that of `out.h5-1` is not taken for one of `out.h5`.
fn is_named_by(prefix: &OsStr, name: &OsStr) -> bool {
    let rest = name.as_encoded_bytes().strip_prefix(prefix.as_encoded_bytes());
    let numbers = rest.and_then(|rest| rest.strip_suffix(SUFFIX.as_bytes())).unwrap_or_default();
    let parts: Vec<_> = numbers.split(|byte| *byte == b'-').collect();
    parts.len() == 2 && parts.iter().all(|part| !part.is_empty() && part.iter().all(u8::is_ascii_digit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_left_of_one_file_is_removed() {
        let folder = std::env::temp_dir().join(format!("curveflow-temporary-{}", process::id()));
        fs::create_dir_all(&folder).unwrap();
        let left = [".out.h5-17-0.partial", ".out.h5-18-123.partial"];
        let others =
            [".out.h5-1-17-0.partial", ".out.h5-17.partial", ".out.h5-a-0.partial", ".xout.h5-17-0.partial"];
        for name in left.iter().chain(&others) {
            fs::write(folder.join(name), b"half of it").unwrap();
        }
        remove_left(&folder.join("out.h5"));
        let mut names: Vec<_> =
            fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(names, others);
    }

    #[test]
    fn names_as_long_as_the_system_allows_have_temporary_files() {
        let target = std::env::temp_dir().join("κ".repeat(127));
        let temporary = Temporary::beside(&target).unwrap();
        assert!(temporary.path.exists());
    }
}
