//! Opens a result file for the library, once it has been looked at.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use hdf5_metno::{Error, File};

use super::heaps::{broken_heap, has_wide_lengths};
use crate::output::memory::check_room;
use crate::output::{Operation, StorageError};

/// The first bytes of every HDF5 file.
const SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";

/// Bytes in which every HDF5 file says how long its lengths are.
const FIRST_BLOCK: usize = 48;

/// What reading takes at once, in multiples of the file: that of the library, and the record.
const COPIES: u64 = 2;

/// A file that the library has open.
pub(super) struct Opened {
    pub content: File,
    /// Kept open as long: the library takes two open files of one name for the same one.
    _file: fs::File,
}

/// Opens the file `path`, whose length in bytes is returned too.
pub(super) fn open(
    path: &Path,
    damaged: &impl Fn(&str, Error) -> StorageError,
    foreign: &impl Fn(Option<String>) -> StorageError,
) -> Result<(Opened, u64), StorageError> {
    let failed = |reason| StorageError::system(path, Operation::Read, reason);
    // Asked before opening: opening a pipe would wait for its other end.
    if !fs::metadata(path).map_err(failed)?.is_file() {
        return Err(StorageError::NotAFile { path: path.to_path_buf() });
    }
    let mut file = fs::File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.by_ref().take(SIGNATURE.len() as u64).read_to_end(&mut bytes).map_err(failed)?;
    if bytes != SIGNATURE {
        return Err(StorageError::NotHdf5 { path: path.to_path_buf() });
    }
    file.read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() > FIRST_BLOCK && !has_wide_lengths(&bytes) {
        return Err(foreign(None));
    }
    if let Some(place) = broken_heap(&bytes) {
        return Err(damaged("its texts", format!("the heap at byte {place} does not add up").into()));
    }
    let length = bytes.len() as u64;
    drop(bytes);
    check_room(length.saturating_mul(COPIES)).map_err(failed)?;
    let name = name(&file, path);
    if name.to_str().is_none() {
        return Err(StorageError::NotUtf8 { path: path.to_path_buf() });
    }
    // The library reads the whole file at once and takes no lock on it.
    let content = File::with_options().with_fapl(|plist| plist.core_filebacked(false)).open(name);
    let content = content.map_err(|source| damaged("its first block", source))?;
    Ok((Opened { content, _file: file }, length))
}

/// A name of the open file for the library: by `path` it might find another one, which has taken the place of this one meanwhile.
#[cfg(target_os = "linux")]
fn name(file: &fs::File, path: &Path) -> PathBuf {
    use std::os::fd::AsRawFd;
    let name = PathBuf::from(format!("/proc/self/fd/{}", file.as_raw_fd()));
    if name.exists() { name } else { path.to_path_buf() }
}

/// Elsewhere it has none.
#[cfg(not(target_os = "linux"))]
fn name(_: &fs::File, path: &Path) -> PathBuf {
    path.to_path_buf()
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn what_was_looked_at_is_what_is_read() {
        let path = std::env::temp_dir().join(format!("curveflow-opening-{}.h5", std::process::id()));
        fs::write(&path, "the first").unwrap();
        let file = fs::File::open(&path).unwrap();
        let other = path.with_extension("other");
        fs::write(&other, "the second one").unwrap();
        fs::rename(&other, &path).unwrap();
        assert_eq!(fs::read_to_string(name(&file, &path)).unwrap(), "the first");
        fs::remove_file(&path).unwrap();
    }
}
