//! Writes a file so that its name holds either the old content or all of the new, even after a crash.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::links::followed;
use super::temporary::Temporary;
use super::{Operation, StorageError};

/// Writes `bytes` to `path`; an existing file is replaced only if `replace`.
///
/// The bytes go to a temporary file in the same folder, then to the disk, and get their name in one step. A
/// symbolic link is followed, also to a file that is not there yet: its target is replaced or made, the link stays.
/// # Errors
/// [`StorageError`]; the target is then as it was, and no temporary file is left.
pub fn write(path: &Path, bytes: &[u8], replace: bool) -> Result<(), StorageError> {
    write_with(path, replace, |file| file.write_all(bytes))
}

/// Checks that [`write()`] can create `path` now, so that a long run fails before it starts. Leaves nothing behind.
/// # Errors
/// The [`StorageError`] that [`write()`] would give.
pub fn check_writable(path: &Path, replace: bool) -> Result<(), StorageError> {
    Target::new(path, replace)?.temporary().map(drop)
}

/// As [`write()`], with what `content` writes.
/// # Errors
/// As for [`write()`].
pub(super) fn write_with(
    path: &Path,
    replace: bool,
    content: impl FnOnce(&mut File) -> io::Result<()>,
) -> Result<(), StorageError> {
    let target = Target::new(path, replace)?;
    let mut temporary = target.temporary()?;
    let failed = |operation| move |reason| StorageError::system(path, operation, reason);
    content(&mut temporary.file).map_err(failed(Operation::Write))?;
    if let Some(permissions) = target.permissions.clone() {
        temporary.file.set_permissions(permissions).map_err(failed(Operation::Write))?;
    }
    temporary.file.sync_all().map_err(failed(Operation::Sync))?;
    if replace {
        fs::rename(&temporary.path, &target.path).map_err(failed(Operation::Rename))?;
    } else {
        name_without_replacing(&temporary.path, &target.path).map_err(|reason| match reason.kind() {
            ErrorKind::AlreadyExists => StorageError::Exists { path: path.to_path_buf() },
            _ => StorageError::system(path, Operation::Rename, reason),
        })?;
    }
    drop(temporary);
    sync_folder(&target.folder).map_err(failed(Operation::Sync))
}

/// A file that may be written.
struct Target {
    path: PathBuf,
    folder: PathBuf,
    /// Permissions of the file that is replaced.
    permissions: Option<fs::Permissions>,
}

impl Target {
    fn new(given: &Path, replace: bool) -> Result<Self, StorageError> {
        // Asked of the system first: what a link to a pipe says of its target names no file.
        if fs::metadata(given).is_ok_and(|found| !found.is_file()) {
            return Err(StorageError::NotAFile { path: given.to_path_buf() });
        }
        let path = followed(given);
        if path.file_name().is_none() {
            return Err(StorageError::NotAFile { path: given.to_path_buf() });
        }
        let folder = match path.parent() {
            Some(parent) if parent != Path::new("") => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        let permissions = match fs::symlink_metadata(&path) {
            Ok(found) if !found.is_file() => {
                return Err(StorageError::NotAFile { path: given.to_path_buf() });
            }
            Ok(_) if !replace => return Err(StorageError::Exists { path: given.to_path_buf() }),
            Ok(found) if found.permissions().readonly() => {
                return Err(StorageError::Protected { path: given.to_path_buf() });
            }
            Ok(found) => Some(found.permissions()),
            Err(_) if !folder.is_dir() => {
                return Err(StorageError::FolderMissing { path: given.to_path_buf(), folder });
            }
            Err(reason) if reason.kind() == ErrorKind::NotFound => None,
            Err(reason) => return Err(StorageError::system(given, Operation::Create, reason)),
        };
        Ok(Self { path, folder, permissions })
    }

    fn temporary(&self) -> Result<Temporary, StorageError> {
        Temporary::beside(&self.path)
            .map_err(|reason| StorageError::system(&self.path, Operation::Create, reason))
    }
}

/// Gives the file `from` the name `to`, in one step that fails if `to` exists.
fn name_without_replacing(from: &Path, to: &Path) -> io::Result<()> {
    match fs::hard_link(from, to) {
        Err(reason) if reason.kind() != ErrorKind::AlreadyExists => {
            // A file system without hard links: take the name first, then replace what we have just made.
            OpenOptions::new().write(true).create_new(true).open(to)?;
            fs::rename(from, to).inspect_err(|_| {
                let _ = fs::remove_file(to);
            })
        }
        done => done,
    }
}

/// Hands the name of a new file to the disk.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        // Some network file systems cannot; their own rules hold then.
        Err(reason) if matches!(reason.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Ok(()),
        done => done,
    }
}

/// Other systems have no such call.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::process;

    use super::*;

    /// A fresh folder, removed at the end of the test.
    struct Folder(PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("curveflow-{name}-{}", process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn files(&self) -> usize {
            fs::read_dir(&self.0).unwrap().count()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn an_existing_file_survives_unless_it_may_be_replaced() {
        let folder = Folder::new("replace");
        let path = folder.0.join("out.h5");
        write(&path, b"first", false).unwrap();
        assert!(matches!(check_writable(&path, false), Err(StorageError::Exists { .. })));
        assert!(matches!(write(&path, b"second", false), Err(StorageError::Exists { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"first");
        check_writable(&path, true).unwrap();
        write(&path, b"second", true).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(folder.files(), 1);
    }

    /// The name is taken between the check and the end of the write: the other file wins.
    #[test]
    fn a_race_never_overwrites() {
        let folder = Folder::new("race");
        let path = folder.0.join("out.h5");
        let result = write_with(&path, false, |file| {
            fs::write(&path, b"other")?;
            file.write_all(b"ours")
        });
        assert!(matches!(result, Err(StorageError::Exists { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"other");
        assert_eq!(folder.files(), 1);
    }

    /// The disk fills up half-way: the old file is intact and nothing else is left.
    #[test]
    fn a_full_disk_leaves_the_old_file() {
        let folder = Folder::new("full");
        let path = folder.0.join("out.h5");
        write(&path, b"old", false).unwrap();
        let result = write_with(&path, true, |file| {
            file.write_all(b"half of it")?;
            Err(ErrorKind::StorageFull.into())
        });
        let message = result.unwrap_err().to_string();
        assert!(message.contains("out.h5: cannot write") && message.contains("free some space"), "{message}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(folder.files(), 1);
    }

    #[test]
    fn folders_devices_and_missing_folders_are_refused_early() {
        let folder = Folder::new("early");
        assert!(matches!(check_writable(&folder.0, true), Err(StorageError::NotAFile { .. })));
        let missing = folder.0.join("none").join("out.h5");
        assert!(matches!(check_writable(&missing, false), Err(StorageError::FolderMissing { .. })));
        if cfg!(target_os = "linux") {
            assert!(matches!(
                check_writable(Path::new("/dev/null"), true),
                Err(StorageError::NotAFile { .. })
            ));
            let refused = check_writable(Path::new("/proc/out.h5"), false);
            assert!(matches!(refused, Err(StorageError::System { operation: Operation::Create, .. })));
        }
        assert_eq!(folder.files(), 0);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_are_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = Folder::new("link");
        let (path, link) = (folder.0.join("out.h5"), folder.0.join("latest.h5"));
        fs::write(&path, b"old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&path, &link).unwrap();
        write(&link, b"new", true).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        fs::set_permissions(&path, fs::Permissions::from_mode(0o440)).unwrap();
        assert!(matches!(write(&path, b"x", true), Err(StorageError::Protected { .. })));
        fs::remove_file(&path).unwrap();
        write(&link, b"newer", false).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"newer");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
