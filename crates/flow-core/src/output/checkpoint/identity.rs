//! Which file it is, by its content: also if it was moved or copied meanwhile.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// Length and CRC-32 of a file, or of a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    pub(super) bytes: u64,
    pub(super) checksum: u32,
}

impl Identity {
    /// That of the file `path`.
    ///
    /// # Errors
    /// What the system says if it is no plain file, or cannot be read.
    pub fn of(path: &Path) -> io::Result<Self> {
        if !fs::metadata(path)?.is_file() {
            return Err(io::ErrorKind::InvalidInput.into()); // a pipe would wait for its other end
        }
        let mut tally = Tally::default();
        io::copy(&mut File::open(path)?, &mut tally)?;
        Ok(tally.identity())
    }
}

/// Takes the bytes of which the identity is asked.
#[derive(Default)]
pub(super) struct Tally {
    bytes: u64,
    checksum: crc32fast::Hasher,
}

impl Tally {
    pub fn identity(self) -> Identity {
        Identity { bytes: self.bytes, checksum: self.checksum.finalize() }
    }
}

impl Write for Tally {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bytes += bytes.len() as u64;
        self.checksum.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
